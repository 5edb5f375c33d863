//! The XML of a VTU file: which arrays there are and where their data stand, undecoded.

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::io::refusal::{code, excerpt, refuse};
use crate::io::scalars::{ByteOrder, Scalar};
use crate::io::{Format, ReadError};

/// A file, its arrays undecoded.
pub(super) struct XmlFile<'a> {
    pub order: ByteOrder,
    /// The type of sizes before binary data.
    pub header: Scalar,
    /// True if binary data are compressed with zlib.
    pub compressed: bool,
    pub pieces: Vec<Piece<'a>>,
    pub field_data: Vec<DataArray<'a>>,
    /// The data after the `_` of the appended part, and whether they are base64.
    pub appended: Option<(&'a [u8], bool)>,
}

/// A part of the grid with its own nodes.
#[derive(Default)]
pub(super) struct Piece<'a> {
    pub node_count: u64,
    pub cell_count: u64,
    pub points: Option<DataArray<'a>>,
    /// `connectivity`, `offsets` and `types`.
    pub cells: Vec<DataArray<'a>>,
    pub cell_data: Vec<DataArray<'a>>,
    pub point_data: Vec<DataArray<'a>>,
}

/// An array.
pub(super) struct DataArray<'a> {
    pub name: String,
    /// `None` if the type is none of numbers.
    pub scalar: Option<Scalar>,
    pub components: usize,
    pub place: Place,
    /// The text in the element.
    pub text: &'a [u8],
    /// Where in the file the text starts.
    pub text_at: usize,
    /// Where in the file the element starts, to tell the line.
    pub at: usize,
}

/// Where and how the numbers of an array stand.
#[derive(Clone, Copy)]
pub(super) enum Place {
    /// Words in the element.
    Ascii,
    /// Base64 in the element.
    Binary,
    /// That many bytes into the appended data.
    Appended(usize),
}

/// The elements that matter.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Element {
    Points,
    Cells,
    CellData,
    PointData,
    FieldData,
    DataArray,
    Other,
}

/// An error at a byte of the file.
pub(super) fn refuse_at(bytes: &[u8], at: usize, code: &'static str, message: String) -> ReadError {
    refuse(Format::Vtu, line_at(bytes, at), code, message)
}

/// The line that a byte of the file is in.
pub(super) fn line_at(bytes: &[u8], at: usize) -> u64 {
    memchr::memchr_iter(b'\n', &bytes[..at.min(bytes.len())]).count() as u64 + 1
}

/// Parses the XML up to its end or to the appended data.
pub(super) fn parse(bytes: &[u8]) -> Result<XmlFile<'_>, ReadError> {
    let mut parser = Parser { bytes, file: None, open: Vec::new(), array: None };
    let mut reader = Reader::from_reader(bytes);
    reader.config_mut().check_comments = false;
    loop {
        let start = reader.buffer_position() as usize;
        let event = reader.read_event().map_err(|error| {
            let at = reader.error_position() as usize;
            let message = format!("the XML is not well formed: {error}");
            refuse_at(bytes, at, code::SYNTAX, message)
        })?;
        let end = reader.buffer_position() as usize;
        match event {
            Event::Start(element) if element.name().as_ref() == "AppendedData" => {
                return parser.appended(&element, start, end);
            }
            Event::Start(element) => {
                let kind = parser.start(&element, start)?;
                parser.open.push(kind);
            }
            Event::Empty(element) => {
                let kind = parser.start(&element, start)?;
                if kind == Element::DataArray {
                    parser.end_array();
                }
            }
            Event::Text(_) | Event::CData(_) => parser.text(&bytes[start..end], start),
            Event::End(element) => {
                if parser.open.pop() == Some(Element::DataArray) {
                    parser.end_array();
                }
                if element.name().as_ref() == "VTKFile" {
                    // Appended data may only come before this.
                    break;
                }
            }
            Event::Eof => {
                return Err(match parser.file {
                    None => not_vtu(bytes, start, "there is no VTKFile element"),
                    Some(_) => refuse_at(
                        bytes,
                        start,
                        code::TRUNCATED,
                        "the file ends before </VTKFile> — it is cut short".into(),
                    ),
                });
            }
            _ => {}
        }
    }
    parser.file.ok_or_else(|| not_vtu(bytes, 0, "there is no VTKFile element"))
}

fn not_vtu(bytes: &[u8], at: usize, why: &str) -> ReadError {
    refuse_at(bytes, at, code::NOT_THIS_FORMAT, format!("this is not a VTU file: {why}"))
}

struct Parser<'a> {
    bytes: &'a [u8],
    file: Option<XmlFile<'a>>,
    open: Vec<Element>,
    array: Option<DataArray<'a>>,
}

impl<'a> Parser<'a> {
    fn start(&mut self, element: &BytesStart<'_>, at: usize) -> Result<Element, ReadError> {
        let name = element.name();
        let Some(file) = &mut self.file else {
            if name.as_ref() != "VTKFile" {
                let found = excerpt(name.as_ref().as_bytes());
                return Err(not_vtu(self.bytes, at, &format!("its first element is {found}, not VTKFile")));
            }
            self.file = Some(parse_header(self.bytes, element, at)?);
            return Ok(Element::Other);
        };
        Ok(match name.as_ref() {
            "Piece" => {
                let piece = Piece {
                    node_count: number(self.bytes, element, at, "NumberOfPoints", None)?,
                    cell_count: number(self.bytes, element, at, "NumberOfCells", None)?,
                    ..Piece::default()
                };
                file.pieces.push(piece);
                Element::Other
            }
            "Points" => Element::Points,
            "Cells" => Element::Cells,
            "CellData" => Element::CellData,
            "PointData" => Element::PointData,
            "FieldData" => Element::FieldData,
            "DataArray" => {
                self.array = Some(parse_array(self.bytes, element, at)?);
                Element::DataArray
            }
            _ => Element::Other,
        })
    }

    fn text(&mut self, text: &'a [u8], at: usize) {
        let blank = text.iter().all(u8::is_ascii_whitespace);
        if let Some(array) = self.array.as_mut().filter(|_| !blank) {
            // VTK also puts InformationKey elements into an array, with text of their own.
            if self.open.last() == Some(&Element::DataArray) {
                (array.text, array.text_at) = (text, at);
            }
        }
    }

    /// Puts the array that has just ended where it belongs.
    fn end_array(&mut self) {
        let (Some(array), Some(file)) = (self.array.take(), &mut self.file) else { return };
        let owner = self.open.iter().rev().find(|element| **element != Element::DataArray);
        if owner == Some(&Element::FieldData) {
            file.field_data.push(array);
            return;
        }
        let Some(piece) = file.pieces.last_mut() else { return };
        match owner {
            Some(Element::Points) => piece.points = Some(array),
            Some(Element::Cells) => piece.cells.push(array),
            Some(Element::CellData) => piece.cell_data.push(array),
            Some(Element::PointData) => piece.point_data.push(array),
            _ => {}
        }
    }

    /// The file with its appended data, which are the last of it that is looked at.
    fn appended(self, element: &BytesStart<'_>, at: usize, end: usize) -> Result<XmlFile<'a>, ReadError> {
        let mut file = self.file.ok_or_else(|| not_vtu(self.bytes, at, "there is no VTKFile element"))?;
        let base64 = match attribute(self.bytes, element, at, "encoding")?.as_deref() {
            Some("raw") => false,
            Some("base64") | None => true,
            Some(other) => {
                let message = format!("the appended data are encoded as '{other}'; raw and base64 are read");
                return Err(refuse_at(self.bytes, at, code::UNSUPPORTED_ENCODING, message));
            }
        };
        let rest = &self.bytes[end..];
        let Some(underscore) =
            rest.iter().position(|b| !b.is_ascii_whitespace()).filter(|&i| rest[i] == b'_')
        else {
            let message = "the appended data do not begin with '_'";
            return Err(refuse_at(self.bytes, end, code::SYNTAX, message.into()));
        };
        let data = &rest[underscore + 1..];
        let stop = if base64 { memchr::memchr(b'<', data).unwrap_or(data.len()) } else { data.len() };
        file.appended = Some((data[..stop].trim_ascii_end(), base64));
        if !base64 {
            file.appended = Some((data, false));
        }
        Ok(file)
    }
}

fn parse_header<'a>(bytes: &[u8], element: &BytesStart<'_>, at: usize) -> Result<XmlFile<'a>, ReadError> {
    let get = |name: &str| attribute(bytes, element, at, name);
    let kind = get("type")?.unwrap_or_default();
    if kind != "UnstructuredGrid" {
        let message = format!(
            "the file holds '{kind}'; only UnstructuredGrid is read — convert it, in ParaView for instance"
        );
        return Err(refuse_at(bytes, at, code::UNSUPPORTED_FEATURE, message));
    }
    let order = match get("byte_order")?.as_deref() {
        Some("BigEndian") => ByteOrder::Big,
        _ => ByteOrder::Little,
    };
    let header = match get("header_type")?.as_deref() {
        None | Some("UInt32") => Scalar::Unsigned(4),
        Some("UInt64") => Scalar::Unsigned(8),
        Some(other) => {
            let message = format!("the header type is '{other}'; UInt32 and UInt64 are read");
            return Err(refuse_at(bytes, at, code::UNSUPPORTED_ENCODING, message));
        }
    };
    let compressed = match get("compressor")?.as_deref() {
        None | Some("") => false,
        Some("vtkZLibDataCompressor") => true,
        Some(other) => {
            let message = format!(
                "the data are compressed by {other}; only zlib is read — save the file with \
                 vtkZLibDataCompressor or without compression"
            );
            return Err(refuse_at(bytes, at, code::UNSUPPORTED_ENCODING, message));
        }
    };
    Ok(XmlFile { order, header, compressed, pieces: Vec::new(), field_data: Vec::new(), appended: None })
}

fn parse_array<'a>(bytes: &[u8], element: &BytesStart<'_>, at: usize) -> Result<DataArray<'a>, ReadError> {
    let get = |name: &str| attribute(bytes, element, at, name);
    let place = match get("format")?.as_deref() {
        None | Some("ascii") => Place::Ascii,
        Some("binary") => Place::Binary,
        Some("appended") => Place::Appended(number(bytes, element, at, "offset", None)? as usize),
        Some(other) => {
            let message = format!("an array has the format '{other}'; ascii, binary and appended are read");
            return Err(refuse_at(bytes, at, code::UNSUPPORTED_ENCODING, message));
        }
    };
    Ok(DataArray {
        name: get("Name")?.unwrap_or_default(),
        scalar: get("type")?.and_then(|name| Scalar::from_xml_name(name.as_bytes())),
        components: number(bytes, element, at, "NumberOfComponents", Some(1))? as usize,
        place,
        text: &[],
        text_at: at,
        at,
    })
}

/// The value of an attribute, if it is there.
fn attribute(
    bytes: &[u8],
    element: &BytesStart<'_>,
    at: usize,
    name: &str,
) -> Result<Option<String>, ReadError> {
    let found = element.try_get_attribute(name).map_err(|error| {
        refuse_at(bytes, at, code::SYNTAX, format!("the attributes are not well formed: {error}"))
    })?;
    Ok(found.map(|attribute| attribute.value.trim().to_owned()))
}

/// The value of an attribute that is a count; where it is missing or empty, `default`.
fn number(
    bytes: &[u8],
    element: &BytesStart<'_>,
    at: usize,
    name: &str,
    default: Option<u64>,
) -> Result<u64, ReadError> {
    let value = attribute(bytes, element, at, name)?.filter(|value| !value.is_empty());
    let parsed = value.as_ref().map_or(default, |value| value.parse().ok());
    parsed.ok_or_else(|| {
        let message = match value {
            Some(value) => format!("{name} is {}; it must be a count", excerpt(value.as_bytes())),
            None => format!("the attribute {name} is missing"),
        };
        refuse_at(bytes, at, code::BAD_NUMBER, message)
    })
}
