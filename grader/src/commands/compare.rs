//! `grader compare`.

use std::fmt::Display;
use std::io::BufReader;
use std::path::Path;

use cases::answer::{ImageAnswer, Limits};
use cases::film::{Image, PictureError, Rows, read_exact};
use grader::grade::GradeError;
use grader::judge;
use grader::record::Verdict;

use crate::arguments::Compare;
use crate::exit::{Done, Outcome};

/// Pixels in a row, and rows, that a picture may have.
const MAX_SIDE: u32 = 16_384;
/// Pixels that are decoded before they are compared: few enough to stay near the processor.
const BAND_PIXELS: usize = 1 << 15;
/// Pictures of fewer pixels are decoded before a second thread has started.
const LEAST_SHARED: usize = 1 << 18;
/// Bytes of a file that are read at once.
const FILE_BYTES: usize = 1 << 16;

pub(crate) fn run(arguments: &Compare) -> Outcome {
    if let (Some(b), None) = (&arguments.b, &arguments.answer)
        && let Some(done) = by_rows(&arguments.a, b, arguments.tolerance.unwrap_or(0.0))?
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

/// Compares two PNGs of 8 bits a channel, decoded side by side, some rows at a time; `None` where they are something else.
fn by_rows(a_path: &Path, b_path: &Path, slack: f64) -> Result<Option<Done>, GradeError> {
    let (Some(mut a), Some(mut b)) = (rows(a_path)?, rows(b_path)?) else { return Ok(None) };
    same_size((a_path, (a.width, a.height)), (b_path, (b.width, b.height)))?;
    let (width, height) = (a.width as usize, a.height as usize);
    let n_rows = (BAND_PIXELS / width).clamp(1, height);
    let (mut one, mut other) = (vec![0; n_rows * width * 3], vec![0; n_rows * width * 3]);
    let mut compared = judge::RowsCompared::new(a.width, slack);
    for first in (0..height).step_by(n_rows) {
        let n = n_rows.min(height - first) * width * 3;
        let (one, other) = (&mut one[..n], &mut other[..n]);
        let read = |rows: &mut File, levels: &mut [u8], path| rows.read(levels).map_err(|why| unreadable(path, &why));
        let (mut read_a, mut read_b) = (|| read(&mut a, one, a_path), || read(&mut b, other, b_path));
        let (a_read, b_read) =
            if width * height < LEAST_SHARED { (read_a(), read_b()) } else { rayon::join(read_a, read_b) };
        a_read.and(b_read)?;
        compared.take(one, other);
    }
    let (difference, text) = compared.finish();
    let agree = difference.n_out == 0;
    match agree {
        true => anstream::println!("they agree: no pixel differs by more than {slack} levels"),
        false => anstream::println!("{text}"),
    }
    Ok(Some(Done::of(agree)))
}

/// A PNG whose rows are decoded as they are asked for.
type File = Rows<BufReader<std::fs::File>>;

fn rows(path: &Path) -> Result<Option<File>, GradeError> {
    let file = std::fs::File::open(path).map_err(|why| unreadable(path, &why))?;
    Rows::open(BufReader::with_capacity(FILE_BYTES, file), MAX_SIDE).map_err(|why| unreadable(path, &why))
}

fn unreadable(path: &Path, why: &dyn Display) -> GradeError {
    GradeError::Input(format!("{}: {why}", path.display()))
}

fn bytes(path: &Path) -> Result<Vec<u8>, GradeError> {
    std::fs::read(path).map_err(|why| unreadable(path, &why))
}

/// Reads a picture of whatever size it says, within reason.
fn read(path: &Path) -> Result<Image, GradeError> {
    let bytes = bytes(path)?;
    let wrong = |why: PictureError| unreadable(path, &why);
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
    ImageAnswer::decode(&bytes(path)?, picture.width(), picture.height()).map_err(|why| unreadable(path, &why))
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
