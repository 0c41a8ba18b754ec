//! The pictures of mistakes that are stored with a case.

use cases::answer::{Wrong, image_answer_path, load};
use cases::film::PictureError;
use cases::stage::Case;

use crate::exam::Exam;

/// The reason why the mistakes that are stored with a case cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{case}: the stored mistakes cannot be read")]
pub struct LayersError {
    /// The id of the case.
    pub case: String,
    /// The fault of the file.
    pub source: PictureError,
}

/// Returns the pictures of mistakes that are stored with a case.
pub(super) fn layers(exam: &Exam, case: &Case) -> Result<Vec<Wrong>, LayersError> {
    let size = case.scene.render;
    let bytes = load::bytes(&image_answer_path(&exam.folder, &case.id)).unwrap_or_default();
    Wrong::decode_all(&bytes, size.width, size.height)
        .map_err(|source| LayersError { case: case.id.clone(), source })
}
