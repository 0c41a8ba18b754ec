//! The names of film mistakes, and the sentences for a student.

use cases::answer::Mistake;

use super::moves::Move;

/// The mistake of the list that reverses the rows.
const UPSIDE_DOWN: &str = "upside_down";

/// A mistake that a program makes in all of its pictures after the light is computed.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct FilmMistake {
    /// The kind of the mistake.
    pub(in super::super) kind: Kind,
    /// The cases that it explains, each with its number of explained pixels.
    pub(in super::super) cases: Vec<(String, usize)>,
    /// The share of the out pixels of all cases that it explains, 0 to 1.
    pub(in super::super) share: f64,
}

/// The kinds of film mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Kind {
    /// Pixels or channels stand in other places.
    Moved(Move),
    /// The last rows are missing; the number of rows in most cases.
    RowsMissing(usize),
    /// Light above full becomes dark.
    Wrapped,
    /// All levels pass through a curve; what it makes of level 128 in each channel.
    Curve([i16; 3]),
}

impl Kind {
    /// Returns the mistake to name. Reversed rows are the mistake of the list `known`, if the list
    /// has it. Other film mistakes break no rule of light, so their rule is 0, and no function of
    /// the template makes them.
    pub(in super::super) fn mistake(self, known: &[Mistake]) -> Mistake {
        let listed = known.iter().find(|one| one.id == UPSIDE_DOWN);
        if let (Self::Moved(Move::UpsideDown(_)), Some(listed)) = (self, listed) {
            return listed.clone();
        }
        let (id, field) = self.name();
        Mistake {
            id: id.to_owned(),
            rule: 0,
            says: self.says(),
            look_at: String::new(),
            field: field.to_owned(),
        }
    }

    /// Returns the name and the decision that is wrong.
    fn name(self) -> (&'static str, &'static str) {
        match self {
            Self::Moved(Move::UpsideDown(_)) => (UPSIDE_DOWN, "rows_from_top"),
            Self::Moved(Move::Mirrored) => ("mirrored", "film_order"),
            Self::Moved(Move::Turned) => ("turned_around", "film_order"),
            Self::Moved(Move::Exchanged) => ("rows_and_columns_exchanged", "film_order"),
            Self::Moved(Move::Shifted(..)) => ("shifted", "film_order"),
            Self::Moved(Move::Channels(_)) => ("channels_exchanged", "film_channels"),
            Self::RowsMissing(_) => ("last_rows_missing", "film_rows"),
            Self::Wrapped => ("wraps_at_256", "film_levels"),
            Self::Curve(_) => ("levels_through_a_curve", "film_levels"),
        }
    }

    fn says(self) -> String {
        match self {
            Self::Moved(Move::UpsideDown(_)) => {
                "rows are counted from the wrong end, so that the picture is upside down".to_owned()
            }
            Self::Moved(Move::Mirrored) => {
                "columns are counted from the wrong end, so that the picture is mirrored".to_owned()
            }
            Self::Moved(Move::Turned) => {
                "rows and columns are counted from the wrong end, so that the picture is turned by \
                 180°"
                    .to_owned()
            }
            Self::Moved(Move::Exchanged) => {
                "rows and columns are exchanged where the picture is written".to_owned()
            }
            Self::Moved(Move::Shifted(right, down)) => {
                format!("the picture stands {} off its place", shift(right, down))
            }
            Self::Moved(Move::Channels(order)) => {
                let names = order.map(|at| ["red", "green", "blue"][at]);
                format!(
                    "channels are exchanged: where red, green and blue belong, the picture has {}, \
                     {} and {}",
                    names[0], names[1], names[2]
                )
            }
            Self::RowsMissing(n) => {
                format!(
                    "the last {} of each picture {}",
                    pages::lines::count(n, "row"),
                    if n == 1 { "is not written" } else { "are not written" }
                )
            }
            Self::Wrapped => {
                "light above 1 becomes dark: a level is not cut at 255 before it is stored"
                    .to_owned()
            }
            Self::Curve([red, green, blue]) => format!(
                "the levels of all pictures pass through a curve that the rules do not have, such \
                 as gamma, tone mapping or another brightness: of level 128 it makes {red} in red, \
                 {green} in green and {blue} in blue"
            ),
        }
    }
}

/// Returns the distance and the direction of a shift in words.
fn shift(right: isize, down: isize) -> String {
    let word = |n: isize, name: &str, ways: [&str; 2]| {
        let way = ways[usize::from(n > 0)];
        (n != 0).then(|| format!("{} {way}", pages::lines::count(n.unsigned_abs(), name)))
    };
    let words = [word(right, "column", ["left", "right"]), word(down, "row", ["up", "down"])];
    words.into_iter().flatten().collect::<Vec<_>>().join(" and ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_mistake_says_what_the_program_does() {
        let says = |kind: Kind| kind.mistake(&[]).says;
        for (kind, part) in [
            (Kind::Moved(Move::Shifted(1, 0)), "stands 1 column right off"),
            (Kind::Moved(Move::Shifted(-1, -1)), "stands 1 column left and 1 row up off"),
            (Kind::Moved(Move::Channels([2, 1, 0])), "the picture has blue, green and red"),
            (Kind::RowsMissing(1), "the last 1 row of each picture is not"),
            (Kind::RowsMissing(60), "the last 60 rows of each picture are not"),
            (Kind::Curve([186, 186, 0]), "it makes 186 in red, 186 in green and 0 in blue"),
        ] {
            assert!(says(kind).contains(part), "{}", says(kind));
        }
    }

    #[test]
    fn reversed_rows_are_the_mistake_of_the_list() {
        let kind = Kind::Moved(Move::UpsideDown(0));
        let listed = Mistake { rule: 1, ..kind.mistake(&[]) };
        assert_eq!(kind.mistake(std::slice::from_ref(&listed)), listed);
        assert_eq!(kind.mistake(&[]).rule, 0);
    }
}
