//! `grader compare`.

use std::path::Path;

use cases::answer::{ImageAnswer, Limits};
use cases::film::{Image, PictureError, Raster, read_exact};
use grader::grade::GradeError;
use grader::judge;
use grader::record::Verdict;

use crate::arguments::Compare;
use crate::exit::{Done, Outcome};

/// Pixels in a row, and rows, that a picture may have.
const MAX_SIDE: u32 = 16_384;

pub(crate) fn run(arguments: &Compare) -> Outcome {
    if let (Some(b), None) = (&arguments.b, &arguments.answer)
        && let Some(done) = rasters(&arguments.a, b, arguments.tolerance.unwrap_or(0.0))?
    {
        return Ok(done);
    }
    let a = read(&arguments.a)?;
    let answer = match (&arguments.b, &arguments.answer) {
        (_, Some(path)) => stored(path, &a)?,
        (Some(path), None) => {
            let expected = read(path)?;
            same_size((&arguments.a, (a.width(), a.height())), (path, (expected.width(), expected.height())))?;
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

/// Compares two PNGs of 8 bits a channel, read side by side; `None` where they are something else.
fn rasters(a_path: &Path, b_path: &Path, slack: f64) -> Result<Option<Done>, GradeError> {
    let read = |path: &Path| {
        let raster = Raster::read(&bytes(path)?, MAX_SIDE);
        raster.map_err(|why| GradeError::Input(format!("{}: {why}", path.display())))
    };
    let (a, b) = rayon::join(|| read(a_path), || read(b_path));
    let (Some(a), Some(b)) = (a?, b?) else { return Ok(None) };
    same_size((a_path, (a.width, a.height)), (b_path, (b.width, b.height)))?;
    let difference = judge::compare_rasters(&a, &b, slack);
    let agree = difference.n_out == 0;
    match agree {
        true => anstream::println!("they agree: no pixel differs by more than {slack} levels"),
        false => anstream::println!("{}", judge::describe_rasters(&a, &b, &difference)),
    }
    Ok(Some(Done::of(agree)))
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

fn same_size((a_path, a): (&Path, (u32, u32)), (b_path, b): (&Path, (u32, u32))) -> Result<(), GradeError> {
    if a == b {
        return Ok(());
    }
    let (a_name, b_name) = (a_path.display(), b_path.display());
    Err(GradeError::Input(format!(
        "{a_name} is {}×{} pixels, {b_name} is {}×{}: nothing to compare",
        a.0, a.1, b.0, b.1
    )))
}
