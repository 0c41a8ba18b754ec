//! The names of film mistakes, and the sentences for a student.

use cases::answer::Mistake;
use layers::film::{Kind, Move};
use pages::lines::count;

/// The mistake of the list that reverses the rows.
const UPSIDE_DOWN: &str = "upside_down";

/// Returns the mistake to name. Reversed rows are the mistake of the list `known`, if the list
/// has it. Other film mistakes break no rule of light, so their rule is 0, and no function of
/// the template makes them.
pub(super) fn mistake(kind: Kind, known: &[Mistake]) -> Mistake {
    let listed = known.iter().find(|one| one.id == UPSIDE_DOWN);
    if let (Kind::Moved(Move::UpsideDown(_)), Some(listed)) = (kind, listed) {
        return listed.clone();
    }
    let (id, field) = name(kind);
    Mistake {
        id: id.to_owned(),
        rule: 0,
        says: says(kind),
        look_at: String::new(),
        field: field.to_owned(),
    }
}

/// Returns the name and the decision that is wrong.
fn name(kind: Kind) -> (&'static str, &'static str) {
    match kind {
        Kind::Moved(Move::UpsideDown(_)) => (UPSIDE_DOWN, "rows_from_top"),
        Kind::Moved(Move::Mirrored) => ("mirrored", "film_order"),
        Kind::Moved(Move::Turned) => ("turned_around", "film_order"),
        Kind::Moved(Move::Exchanged) => ("rows_and_columns_exchanged", "film_order"),
        Kind::Moved(Move::Shifted(..)) => ("shifted", "film_order"),
        Kind::Moved(Move::Channels(_)) => ("channels_exchanged", "film_channels"),
        Kind::RowsMissing(_) => ("last_rows_missing", "film_rows"),
        Kind::Wrapped => ("wraps_at_256", "film_levels"),
        Kind::Curve(_) => ("levels_through_a_curve", "film_levels"),
    }
}

fn says(kind: Kind) -> String {
    match kind {
        Kind::Moved(Move::UpsideDown(_)) => {
            "rows are counted from the wrong end, so that the picture is upside down".to_owned()
        }
        Kind::Moved(Move::Mirrored) => {
            "columns are counted from the wrong end, so that the picture is mirrored".to_owned()
        }
        Kind::Moved(Move::Turned) => {
            "rows and columns are counted from the wrong end, so that the picture is turned by \
             180°"
                .to_owned()
        }
        Kind::Moved(Move::Exchanged) => {
            "rows and columns are exchanged where the picture is written".to_owned()
        }
        Kind::Moved(Move::Shifted(right, down)) => {
            format!("the picture stands {} off its place", shift(right, down))
        }
        Kind::Moved(Move::Channels(order)) => {
            let names = order.map(|at| ["red", "green", "blue"][at]);
            format!(
                "channels are exchanged: where red, green and blue belong, the picture has {}, \
                 {} and {}",
                names[0], names[1], names[2]
            )
        }
        Kind::RowsMissing(n) => {
            format!(
                "the last {} of each picture {}",
                count(n, "row"),
                if n == 1 { "is not written" } else { "are not written" }
            )
        }
        Kind::Wrapped => {
            "light above 1 becomes dark: a level is not cut at 255 before it is stored".to_owned()
        }
        Kind::Curve([red, green, blue]) => format!(
            "the levels of all pictures pass through a curve that the rules do not have, such \
             as gamma, tone mapping or another brightness: of level 128 it makes {red} in red, \
             {green} in green and {blue} in blue"
        ),
    }
}

/// Returns the distance and the direction of a shift in words.
fn shift(right: isize, down: isize) -> String {
    let word = |n: isize, name: &str, ways: [&str; 2]| {
        let way = ways[usize::from(n > 0)];
        (n != 0).then(|| format!("{} {way}", count(n.unsigned_abs(), name)))
    };
    let words = [word(right, "column", ["left", "right"]), word(down, "row", ["up", "down"])];
    words.into_iter().flatten().collect::<Vec<_>>().join(" and ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_mistake_says_what_the_program_does() {
        let says = |kind: Kind| mistake(kind, &[]).says;
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
        let listed = Mistake { rule: 1, ..mistake(kind, &[]) };
        assert_eq!(mistake(kind, std::slice::from_ref(&listed)), listed);
        assert_eq!(mistake(kind, &[]).rule, 0);
    }
}
