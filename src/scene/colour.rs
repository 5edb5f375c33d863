//! Colour maps: a value of each face becomes one of 255 colours.
//!
//! `Viridis` is matplotlib's map of that name (CC0). The others are made here: `Quality` runs from a
//! strong red (bad) over pale yellow to a calm blue (good), which colour-blind people tell apart and on
//! which dark edges stay visible; `Levels` gives each whole number its own step of an ordered ramp.

/// The index that stands for "this face has no value".
pub const NO_VALUE: u8 = 255;
/// The last index of a colour.
const LAST: u8 = NO_VALUE - 1;
const NO_VALUE_COLOUR: [u8; 3] = [150, 152, 156];

/// How values become colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ColourMap {
    /// Perceptually uniform, dark to bright.
    Viridis,
    /// Bad to good.
    Quality,
    /// One colour a whole number.
    Levels,
}

type Stop = (f64, [u8; 3]);

const VIRIDIS: &[Stop] = &[
    (0.0, [68, 1, 84]),
    (0.0625, [72, 24, 106]),
    (0.125, [71, 45, 123]),
    (0.1875, [66, 64, 134]),
    (0.25, [59, 82, 139]),
    (0.3125, [51, 99, 141]),
    (0.375, [44, 114, 142]),
    (0.4375, [38, 130, 142]),
    (0.5, [33, 145, 140]),
    (0.5625, [31, 160, 136]),
    (0.625, [40, 174, 128]),
    (0.6875, [63, 188, 115]),
    (0.75, [94, 201, 98]),
    (0.8125, [132, 212, 75]),
    (0.875, [173, 220, 48]),
    (0.9375, [216, 226, 25]),
    (1.0, [253, 231, 37]),
];

const QUALITY: &[Stop] = &[
    (0.0, [140, 10, 40]),
    (0.2, [214, 66, 41]),
    (0.4, [246, 145, 75]),
    (0.6, [252, 212, 130]),
    (0.75, [236, 240, 214]),
    (0.88, [150, 200, 226]),
    (1.0, [74, 144, 200]),
];

const LEVELS: &[Stop] = &[
    (0.0, [226, 232, 238]),
    (0.14, [158, 210, 228]),
    (0.29, [92, 170, 214]),
    (0.43, [104, 124, 214]),
    (0.57, [158, 104, 204]),
    (0.71, [212, 96, 170]),
    (0.86, [242, 122, 110]),
    (1.0, [252, 178, 84]),
];

impl ColourMap {
    /// The colour at a place of the map, 0 to 1.
    pub fn colour(self, at: f64) -> [u8; 3] {
        let stops = match self {
            Self::Viridis => VIRIDIS,
            Self::Quality => QUALITY,
            Self::Levels => LEVELS,
        };
        let at = at.clamp(0.0, 1.0);
        let above = stops.partition_point(|s| s.0 < at).clamp(1, stops.len() - 1);
        let ((low, from), (high, to)) = (stops[above - 1], stops[above]);
        let share = (at - low) / (high - low);
        std::array::from_fn(|i| (f64::from(from[i]) * (1.0 - share) + f64::from(to[i]) * share).round() as u8)
    }

    /// The colours of all indices for values in `range`.
    pub fn palette(self, range: [f32; 2]) -> Palette {
        let last = match self {
            Self::Levels => level_count(range).saturating_sub(1).min(LAST.into()),
            _ => LAST.into(),
        };
        let colour = |index: usize| match index {
            _ if index == usize::from(NO_VALUE) => NO_VALUE_COLOUR,
            _ => self.colour(index as f64 / last.max(1) as f64),
        };
        Palette(std::array::from_fn(|i| {
            let [r, g, b] = colour(i);
            [r, g, b, 255]
        }))
    }
}

/// The colours that indices stand for: red, green, blue, 255.
#[derive(Clone, Debug, PartialEq)]
pub struct Palette(pub [[u8; 4]; 256]);

/// How many whole numbers `range` holds.
fn level_count(range: [f32; 2]) -> usize {
    (range[1] - range[0]).round().max(0.0) as usize + 1
}

/// The index of a value's colour in the palette of `map` over `range`. Values outside take the colour
/// of the end; NaN has none.
pub fn colour_index(value: f32, range: [f32; 2], map: ColourMap) -> u8 {
    if value.is_nan() {
        return NO_VALUE;
    }
    let above = value - range[0];
    let index = match map {
        ColourMap::Levels => above.min((level_count(range) - 1) as f32),
        // A range without extent: the middle of the map.
        _ if range[1] <= range[0] => 0.5 * f32::from(LAST),
        _ => above / (range[1] - range[0]) * f32::from(LAST),
    };
    index.round().clamp(0.0, LAST.into()) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_the_range_take_ends_of_the_map() {
        for map in [ColourMap::Viridis, ColourMap::Quality] {
            let palette = map.palette([-2.0, 6.0]).0;
            let at = |v| palette[usize::from(colour_index(v, [-2.0, 6.0], map))];
            assert_eq!(at(-2.0)[..3], map.colour(0.0));
            assert_eq!(at(-9.0), at(-2.0));
            assert_eq!(at(6.0)[..3], map.colour(1.0));
            assert_eq!(at(f32::INFINITY), at(6.0));
            assert_eq!(at(2.0)[..3], map.colour(0.5));
            assert_eq!(at(f32::NAN)[..3], NO_VALUE_COLOUR);
        }
        assert_eq!(ColourMap::Viridis.colour(1.0), [253, 231, 37]);
    }

    #[test]
    fn each_level_has_its_own_colour() {
        let palette = ColourMap::Levels.palette([0.0, 4.0]).0;
        let colours: Vec<_> = (0..=4)
            .map(|l| palette[usize::from(colour_index(l as f32, [0.0, 4.0], ColourMap::Levels))])
            .collect();
        for (i, a) in colours.iter().enumerate() {
            assert!(colours[..i].iter().all(|b| a != b), "{colours:?}");
        }
        assert_eq!(colours[0][..3], ColourMap::Levels.colour(0.0));
        assert_eq!(colours[4][..3], ColourMap::Levels.colour(1.0));
        assert_eq!(colour_index(9.0, [0.0, 4.0], ColourMap::Levels), 4);
    }

    #[test]
    fn a_range_of_one_value_is_fine() {
        assert_eq!(colour_index(3.0, [3.0, 3.0], ColourMap::Viridis), 127);
        assert_eq!(colour_index(3.0, [3.0, 3.0], ColourMap::Levels), 0);
        assert_eq!(ColourMap::Levels.palette([3.0, 3.0]).0[0][..3], ColourMap::Levels.colour(0.0));
    }
}
