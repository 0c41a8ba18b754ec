//! `grader compare`.

use std::path::Path;

use cases::answer::{ImageAnswer, Limits};
use cases::film::{PictureError, Rows, most_bytes};

use crate::cli::arguments::Compare;
use crate::cli::exit::{Done, Outcome, print};
use crate::exam;
use crate::grade::GradeError;
use crate::input::{self, Input};
use crate::judge::{self, RowsCompared};
use crate::record::Verdict;
use crate::sandbox::interrupted;

/// Number of pixels that are decoded before they are compared, few enough to stay in the cache.
const BAND_PIXELS: usize = 1 << 15;
/// A picture of fewer pixels is decoded faster than a second thread starts.
const LEAST_SHARED: usize = 1 << 18;

pub(crate) fn run(arguments: &Compare) -> Outcome {
    let Compare { a, b, answer, tolerance } = arguments;
    match (b, answer) {
        (Some(b), None) => with_other(a, b, tolerance.unwrap_or(0.0)),
        (None, Some(answer)) => with_answer(a, answer, *tolerance),
        _ => Err(GradeError::Usage("name a second picture, or an answer with --answer".to_owned())),
    }
}

/// A picture that is read row by row, with the name that the user typed.
struct Picture<'a> {
    name: &'a Path,
    rows: Rows<Input>,
}

impl<'a> Picture<'a> {
    fn open(name: &'a Path) -> Result<Self, GradeError> {
        let input = input::open(name, |head| most_bytes(head).map_err(|why| why.to_string()))?;
        let rows = Rows::open(input).map_err(|why| unreadable(name, why))?;
        Ok(Self { name, rows })
    }

    fn shown(&self) -> String {
        let (width, height) = self.rows.size();
        format!("{} is {width}×{height}", input::shown(self.name))
    }
}

fn unreadable(name: &Path, source: PictureError) -> GradeError {
    GradeError::Picture { name: name.to_owned(), source }
}

/// Compares two pictures, which are decoded in parallel, band by band.
fn with_other(a: &Path, b: &Path, slack: f64) -> Outcome {
    input::demand_two(a, b)?;
    let (mut a, mut b) = (Picture::open(a)?, Picture::open(b)?);
    let (width, height) = a.rows.size();
    if (width, height) != b.rows.size() {
        return Err(GradeError::Usage(format!(
            "{} pixels, {}: nothing to compare",
            a.shown(),
            b.shown()
        )));
    }
    let mut compared = RowsCompared::new(width, slack);
    if a.rows.has_bytes() && b.rows.has_bytes() {
        bands(&mut a, &mut b, Rows::bytes, |one, other| compared.take(one, other))?;
    } else {
        bands(&mut a, &mut b, Rows::words, |one, other| compared.take_words(one, other))?;
    }
    let comparison = compared.finish();
    let agree = comparison.difference.n_out == 0;
    match agree {
        true => print(&format!("they agree: no pixel differs by more than {slack} levels\n"))?,
        false => print(&format!("{}\n", comparison.text))?,
    }
    Ok(Done::of(agree))
}

/// Reads both pictures with `read`, band by band, and calls `take` with each pair of bands.
fn bands<T: Copy + Default + Send>(
    a: &mut Picture,
    b: &mut Picture,
    read: fn(&mut Rows<Input>, &mut [T]) -> Result<(), PictureError>,
    mut take: impl FnMut(&[T], &[T]),
) -> Result<(), GradeError> {
    let (width, height) = a.rows.size();
    let (width, height) = (width as usize, height as usize);
    let n_rows = (BAND_PIXELS / width).clamp(1, height);
    let (mut one, mut other) =
        (vec![T::default(); n_rows * width * 3], vec![T::default(); n_rows * width * 3]);
    for first in (0..height).step_by(n_rows) {
        if interrupted() {
            return Err(GradeError::Interrupted("comparing"));
        }
        let n = n_rows.min(height - first) * width * 3;
        let (one, other) = (&mut one[..n], &mut other[..n]);
        let read = |picture: &mut Picture, band: &mut [T]| {
            read(&mut picture.rows, band).map_err(|why| unreadable(picture.name, why))
        };
        let (mut read_a, mut read_b) = (|| read(a, one), || read(b, other));
        let (a_read, b_read) = if width * height < LEAST_SHARED {
            (read_a(), read_b())
        } else {
            rayon::join(read_a, read_b)
        };
        a_read.and(b_read)?;
        take(one, other);
    }
    Ok(())
}

/// Judges a picture by a stored answer, as the picture of a submission is judged. The answer must
/// belong to the case beside it.
fn with_answer(name: &Path, answer: &Path, tolerance: Option<f64>) -> Outcome {
    let picture = Picture::open(name)?;
    let answer = stored(answer, picture.rows.size())?;
    let picture = picture.rows.into_image().map_err(|why| unreadable(name, why))?;
    let slack = tolerance.unwrap_or(answer.limits.slack);
    let answer = ImageAnswer { limits: Limits { slack, ..answer.limits }, ..answer };
    let judgement = judge::picture(&picture, &answer);
    let text = match &judgement.finding {
        Some(finding) => finding.message.clone(),
        None => {
            let judge::Difference { n_out, cluster, .. } = judge::compare(&picture, &answer);
            let Limits { count, cluster: most, .. } = answer.limits;
            format!(
                "they agree: {n_out} pixels differ by more than {slack} levels, {cluster} of them \
                 side by side; {count} may, {most} of them side by side"
            )
        }
    };
    print(&format!("{text}\n"))?;
    Ok(Done::of(judgement.verdict == Verdict::Pass))
}

/// Reads the stored answer `name`, which must be one for a picture of `size`.
fn stored(name: &Path, size: (u32, u32)) -> Result<ImageAnswer, GradeError> {
    let answer = exam::stored_answer(name)?;
    let wanted = (answer.expected.width(), answer.expected.height());
    match wanted == size {
        true => Ok(answer),
        false => Err(GradeError::Usage(format!(
            "{} is the answer to a picture of {}×{}, not {}×{}",
            name.display(),
            wanted.0,
            wanted.1,
            size.0,
            size.1
        ))),
    }
}
