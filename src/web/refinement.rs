//! Refinement a level at a time, for a caller's size function that lives in JavaScript.

use std::sync::Arc;

use js_sys::Float64Array;
use self_cell::self_cell;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::candidates::{centers, check_targets, over};
use super::errors::Failure;
use super::listener::Listener;
use super::memory::Affordable;
use super::pool::on_pool;
use super::quads::Quads;
use super::surface::Surface;
use crate::mesh::PolygonMesh;
use crate::refine::{Candidates, QuadOptions, QuadRefinement, RefineError};

/// What a refinement reads: JavaScript knows no lifetimes, so the session keeps it alive.
struct Input {
    mesh: Arc<PolygonMesh>,
    affordable: Affordable<QuadOptions>,
}

type Work<'a> = Option<QuadRefinement<'a>>;

self_cell! {
    struct Session {
        owner: Input,
        #[not_covariant]
        dependent: Work,
    }
}

/// A refinement under way: look at the candidates, [`advance`](Self::advance) while it returns true, then
/// [`finish`](Self::finish).
#[wasm_bindgen]
pub struct Refinement {
    session: Session,
    candidates: Candidates,
}

#[wasm_bindgen]
impl Refinement {
    /// Starts to refine `surface`.
    ///
    /// # Errors
    /// What `QuadRefinement::new` refuses, and options that are none.
    #[wasm_bindgen(constructor)]
    pub fn new(surface: &Surface, options: JsValue) -> Result<Self, Failure> {
        let input = Input { mesh: Arc::clone(&surface.mesh), affordable: Affordable::read(options)? };
        let session = on_pool(|| {
            Session::try_new(input, |input| {
                QuadRefinement::new(&input.mesh, &input.affordable.options, &Listener).map(Some)
            })
        })?;
        let mut refinement = Self { session, candidates: Candidates::default() };
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
    /// If `targets` is not as long as the candidates, or what `QuadRefinement::advance` refuses.
    pub fn advance(&mut self, targets: &[f64]) -> Result<bool, Failure> {
        check_targets(targets, &self.candidates)?;
        let deeper = self.step(|work| work.advance(Some(targets), &Listener))?;
        let deeper = deeper.map_err(|error| self.failure(error))?;
        self.look()?;
        Ok(deeper)
    }

    /// Balances, makes the mesh conform, and returns it. The session is over.
    ///
    /// # Errors
    /// What `QuadRefinement::finish` refuses.
    pub fn finish(mut self) -> Result<Quads, Failure> {
        let work = self.session.with_dependent_mut(|_, work| {
            let work = work.take();
            on_pool(|| work.map(|work| work.finish(&Listener)))
        });
        work.ok_or_else(over)?.map(Quads::from).map_err(|error| self.failure(error))
    }

    fn failure(&self, error: RefineError) -> Failure {
        self.session.borrow_owner().affordable.failure(error)
    }

    fn look(&mut self) -> Result<(), Failure> {
        self.candidates = self.step(|work| work.candidates())?;
        Ok(())
    }

    /// Works on the refinement, unless an error has ended it.
    fn step<R: Send>(
        &mut self,
        work: impl FnOnce(&mut QuadRefinement<'_>) -> R + Send,
    ) -> Result<R, Failure> {
        self.session
            .with_dependent_mut(|_, refinement| on_pool(|| refinement.as_mut().map(work)).ok_or_else(over))
    }
}
