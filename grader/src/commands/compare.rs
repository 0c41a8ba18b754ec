//! `grader compare`.

use std::path::Path;

use cases::answer::{ImageAnswer, Limits};
use cases::film::{Image, PictureError, read_exact};
use grader::grade::GradeError;
use grader::judge;
use grader::record::Verdict;

use crate::arguments::Compare;
use crate::exit::{Done, Outcome};

/// Pixels in a row, and rows, that a picture may have.
const MAX_SIDE: u32 = 16_384;

pub(crate) fn run(arguments: &Compare) -> Outcome {
    let a = read(&arguments.a)?;
    let answer = match (&arguments.b, &arguments.answer) {
        (_, Some(path)) => stored(path, &a)?,
        (Some(path), None) => {
            let expected = read(path)?;
            same_size(&arguments.a, &a, path, &expected)?;
            ImageAnswer::exact(expected, 0.0, 0)
        }
        (None, None) => return Err(GradeError::Input("say what to compare with".to_owned())),
    };
    let slack = arguments.tolerance.unwrap_or(answer.limits.slack);
    let answer = ImageAnswer { limits: Limits { slack, ..answer.limits }, ..answer };
    let judge::Difference { n_out, cluster, .. } = judge::compare(&a, &answer);
    let judgement = judge::picture(&a, &answer);
    let Limits { count, cluster: most, .. } = answer.limits;
    match &judgement.finding {
        Some(finding) => anstream::println!("{}", finding.message),
        None => anstream::println!(
            "they agree: {n_out} pixels differ by more than {slack} levels, {cluster} of them side by side; {count} may, {most} of them side by side"
        ),
    }
    Ok(Done::of(judgement.verdict == Verdict::Pass))
}

fn bytes(path: &Path) -> Result<Vec<u8>, GradeError> {
    std::fs::read(path).map_err(|why| GradeError::Input(format!("{}: {why}", path.display())))
}

/// Reads a picture of whatever size it says, within reason.
fn read(path: &Path) -> Result<Image, GradeError> {
    let bytes = bytes(path)?;
    let wrong = |why: PictureError| GradeError::Input(format!("{}: {why}", path.display()));
    match read_exact(&bytes, 0, 0) {
        Err(PictureError::Size { found: (width, height), .. }) if width <= MAX_SIDE && height <= MAX_SIDE => {
            read_exact(&bytes, width, height).map_err(wrong)
        }
        Err(PictureError::Size { found: (width, height), .. }) => {
            Err(GradeError::Input(format!("{}: {width}×{height} pixels are too many", path.display())))
        }
        other => other.map_err(wrong),
    }
}

fn stored(path: &Path, picture: &Image) -> Result<ImageAnswer, GradeError> {
    ImageAnswer::decode(&bytes(path)?, picture.width(), picture.height())
        .map_err(|why| GradeError::Input(format!("{}: {why}", path.display())))
}

fn same_size(a_path: &Path, a: &Image, b_path: &Path, b: &Image) -> Result<(), GradeError> {
    if (a.width(), a.height()) == (b.width(), b.height()) {
        return Ok(());
    }
    let (a_name, b_name) = (a_path.display(), b_path.display());
    let (aw, ah, bw, bh) = (a.width(), a.height(), b.width(), b.height());
    Err(GradeError::Input(format!("{a_name} is {aw}×{ah} pixels, {b_name} is {bw}×{bh}: nothing to compare")))
}
