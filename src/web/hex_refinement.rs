//! Refinement of hexes a level at a time, for a caller's size function that lives in JavaScript.

use js_sys::Float64Array;
use self_cell::self_cell;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::candidates::{centers, check_targets, over};
use super::errors::Failure;
use super::hex_mesh::HexMesh;
use super::hexes::{Hexes, told};
use super::listener::Listener;
use super::memory::Affordable;
use super::pool::on_pool;
use crate::refine::Candidates;
use crate::refine::hex::{HexOptions, HexRefinement as Refinement};

type Work<'a> = Option<Refinement<'a>>;
type Options = Affordable<HexOptions>;

self_cell! {
    struct Session {
        owner: Options,
        #[not_covariant]
        dependent: Work,
    }
}

/// A refinement under way: look at the candidates, [`advance`](Self::advance) while it returns true, then
/// [`finish`](Self::finish).
#[wasm_bindgen]
pub struct HexRefinement {
    session: Session,
    candidates: Candidates,
    turned: usize,
}

#[wasm_bindgen]
impl HexRefinement {
    /// Starts to refine `mesh`.
    ///
    /// # Errors
    /// What `HexRefinement::new` of the library refuses, and options that are none.
    #[wasm_bindgen(constructor)]
    pub fn new(input: &HexMesh, options: JsValue) -> Result<Self, Failure> {
        let session = Session::try_new(Affordable::read(options)?, |affordable: &Options| {
            on_pool(|| Refinement::new(&input.mesh, &affordable.options, &Listener))
                .map(Some)
                .map_err(|error| affordable.failure(error))
        })?;
        let mut refinement = Self { session, candidates: Candidates::default(), turned: input.turned };
        refinement.look()?;
        Ok(refinement)
    }

    /// x, y, z of the centre of each element that may be refined next.
    pub fn centers(&self) -> Float64Array {
        centers(&self.candidates)
    }

    /// The longest edge of each element that may be refined next.
    pub fn longest(&self) -> Float64Array {
        self.candidates.longest.as_slice().into()
    }

    /// Refines the candidates that are longer than their entry of `targets`. Returns false if none was.
    ///
    /// # Errors
    /// If `targets` is not as long as the candidates, or what the library's `advance` refuses.
    pub fn advance(&mut self, targets: &[f64]) -> Result<bool, Failure> {
        check_targets(targets, &self.candidates)?;
        let deeper = self.session.with_dependent_mut(|affordable, work| {
            let work = work.as_mut().ok_or_else(over)?;
            on_pool(|| work.advance(Some(targets), &Listener)).map_err(|error| affordable.failure(error))
        })?;
        self.look()?;
        Ok(deeper)
    }

    /// Closes the trees, makes the mesh, and returns it. The session is over.
    ///
    /// # Errors
    /// What the library's `finish` refuses.
    pub fn finish(mut self) -> Result<Hexes, Failure> {
        let refined = self.session.with_dependent_mut(|affordable, work| {
            let work = work.take().ok_or_else(over)?;
            on_pool(|| work.finish(&Listener)).map_err(|error| affordable.failure(error))
        })?;
        Ok(Hexes::new(refined, self.turned))
    }

    /// Closes the trees and tells what [`finish`](Self::finish) would make, as `planHexes` does. The session is over.
    ///
    /// # Errors
    /// What the library's `plan` refuses.
    pub fn plan(mut self) -> Result<JsValue, Failure> {
        let turned = self.turned;
        self.session.with_dependent_mut(|affordable, work| {
            let work = work.take().ok_or_else(over)?;
            let plan = on_pool(|| work.plan(&Listener)).map_err(|error| affordable.failure(error))?;
            told(&plan, turned)
        })
    }

    fn look(&mut self) -> Result<(), Failure> {
        self.candidates = self.session.with_dependent_mut(|affordable, work| {
            let candidates = on_pool(|| work.as_mut().map(|work| work.candidates(&Listener)));
            candidates.ok_or_else(over)?.map_err(|error| affordable.failure(error.into()))
        })?;
        Ok(())
    }
}
