//! Hair to look at: an exact answer depends on the order alone, whatever was asked for before.

mod common;

use common::{CURLY, Counted, asked, exact, refused, show, shown};
use frisure_stylist::Stylist;
use frisure_stylist::order::{Answer, Asked, Effort};

/// The small scene, with wisps that make way for each other.
fn among_wisps() -> String {
    CURLY.replace("\"layers\"", "\"wisps\"").replace("count = 24", "count = 12")
}

/// The same scene with a part replaced.
fn with(asked: &Asked, from: &str, to: &str) -> Asked {
    assert!(asked.text.contains(from), "{from}");
    Asked { text: asked.text.replace(from, to), ..asked.clone() }
}

fn styled() -> Asked {
    let steps = "\n[[step]]\nwet = {}\n[[step]]\ncut = { length = '9 cm' }\n[[step]]\ndry = {}\n";
    asked(&format!("{CURLY}{steps}"), 3)
}

#[test]
fn whatever_was_asked_before_exact_answers_have_the_same_bytes() {
    let first = styled();
    let undone = Asked { done: 1, ..first.clone() };
    let wider = with(&first, "9 mm", "11 mm");
    let thinner = with(&wider, "clumping = 0.5", "clumping = 0.9");
    let shorter = with(&thinner, "'9 cm'", "'6 cm'");
    let darker = with(&shorter, "brown", "black");
    let other = with(&first, "count = 24", "count = 20");
    let chain =
        [&first, &undone, &first, &wider, &thinner, &shorter, &darker, &undone, &other, &first];
    let mut stylist = Stylist::new();
    for (i, asked) in chain.into_iter().enumerate() {
        // Every other one is dragged to.
        if i % 2 == 1 {
            shown(show(&mut stylist, asked, Effort::Coarse, &()));
        }
        let warm = exact(&mut stylist, asked);
        let cold = exact(&mut Stylist::new(), asked);
        assert_eq!(warm.strands, cold.strands, "answer {i}");
        let numbers = |n: frisure_stylist::order::Numbers| frisure_stylist::order::Numbers {
            seconds: 0.0,
            ..n
        };
        assert_eq!(numbers(warm.numbers), numbers(cold.numbers));
        assert_eq!((warm.roots, warm.wetness), (cold.roots, cold.wetness));
    }
}

#[test]
fn among_wisps_too() {
    let first = asked(&among_wisps(), 0);
    let second = with(&first, "9 mm", "10 mm");
    let mut stylist = Stylist::new();
    shown(show(&mut stylist, &first, Effort::Coarse, &()));
    exact(&mut stylist, &first);
    shown(show(&mut stylist, &second, Effort::Coarse, &()));
    let cold = exact(&mut Stylist::new(), &second);
    assert_eq!(exact(&mut stylist, &second).strands, cold.strands);
}

#[test]
fn the_head_is_told_once() {
    let mut stylist = Stylist::new();
    let asked = asked(CURLY, 0);
    assert!(exact(&mut stylist, &asked).head.is_some());
    assert!(exact(&mut stylist, &asked).head.is_none());
    assert!(exact(&mut stylist, &with(&asked, "9 mm", "8 mm")).head.is_none());
}

#[test]
fn coarse_hair_is_some_of_the_same_hair() {
    let mut stylist = Stylist::new();
    let asked = asked(&CURLY.replace("hairs = 300", "hairs = 12_000"), 0);
    let all = exact(&mut stylist, &asked);
    let some = shown(show(&mut stylist, &asked, Effort::Coarse, &()));
    assert!(some.every > 1 && some.numbers.drawn < all.numbers.drawn);
    let points = |shown: &frisure_stylist::order::Shown, hair: usize| {
        let ends = &shown.strands.offsets[hair..hair + 2];
        shown.strands.points[3 * ends[0] as usize..3 * ends[1] as usize].to_vec()
    };
    for hair in 0..some.numbers.drawn {
        assert_eq!(points(&some, hair), points(&all, hair * some.every));
    }
    assert_eq!(some.strands.guide.len(), some.numbers.drawn);
}

#[test]
fn coarse_hair_goes_to_where_exact_hair_is() {
    let mut stylist = Stylist::new();
    let start = asked(&among_wisps(), 0);
    exact(&mut stylist, &start);
    let end = with(&start, "9 mm", "10 mm");
    let far = |some: &frisure_stylist::order::Shown, all: &frisure_stylist::order::Shown| {
        let apart = |(a, b): (&[f32], &[f32])| {
            a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f32>().sqrt()
        };
        let (a, b) = (some.strands.points.chunks(3), all.strands.points.chunks(3));
        a.zip(b).map(apart).sum::<f32>() / (some.strands.points.len() / 3) as f32
    };
    let first = shown(show(&mut stylist, &end, Effort::Coarse, &()));
    for _ in 0..20 {
        shown(show(&mut stylist, &end, Effort::Coarse, &()));
    }
    let late = shown(show(&mut stylist, &end, Effort::Coarse, &()));
    let rest = exact(&mut stylist, &end);
    assert!(far(&late, &rest) <= far(&first, &rest));
    assert!(far(&late, &rest) < 0.01, "{}", far(&late, &rest));
}

#[test]
fn what_was_cancelled_anywhere_goes_on_to_the_same_bytes() {
    let asked = styled();
    let cold = exact(&mut Stylist::new(), &asked);
    let mut stylist = Stylist::new();
    let mut cancelled = 0;
    for most in [0, 1, 7, 30, 60, 110, 200] {
        let watch = Counted::new(most);
        match show(&mut stylist, &asked, Effort::Exact, &watch) {
            Answer::Cancelled => cancelled += 1,
            answer => assert_eq!(shown(answer).strands, cold.strands),
        }
        let coarse = show(&mut stylist, &asked, Effort::Coarse, &Counted::new(most / 2));
        assert!(matches!(coarse, Answer::Cancelled | Answer::Shown(_)), "{coarse:?}");
    }
    assert!(cancelled > 1);
    assert_eq!(exact(&mut stylist, &asked).strands, cold.strands);
}

#[test]
fn progress_is_told() {
    let watch = Counted::new(usize::MAX);
    shown(show(&mut Stylist::new(), &asked(CURLY, 0), Effort::Exact, &watch));
    assert!(watch.told() > 3);
}

#[test]
fn what_cannot_be_is_refused_with_its_line() {
    let mut stylist = Stylist::new();
    let mut refusal =
        |text: &str, done| refused(show(&mut stylist, &asked(text, done), Effort::Exact, &()));
    let unit = refusal("seed = 1\n[hair]\nlength = 9000\n", 0);
    assert_eq!((unit.key.as_str(), unit.line), ("hair.length", 3));
    assert!(!unit.hint.is_empty());
    let unknown = refusal("[hair]\nlenght = '9 cm'\n", 0);
    assert!(unknown.line == 2 && unknown.hint.contains("length"), "{unknown:?}");
    let syntax = refusal("[hair\n", 0);
    assert!(syntax.line == 1 && syntax.key.is_empty());
    let file = refusal("[head]\nmesh = 'nowhere.obj'\n", 0);
    assert_eq!((file.key.as_str(), file.line), ("head.mesh", 2));
    let step = refusal(&format!("{CURLY}\n[[step]]\nwet = {{ where = {{ wisps = [99] }} }}\n"), 1);
    assert!(step.line > 0 && step.key.starts_with("step[0]"), "{step:?}");
    let many = refusal("[wisps]\nhairs = 2_000_000\n", 0);
    assert_eq!((many.key.as_str(), many.line), ("wisps.hairs", 2));
    let crowded = refusal("[wisps]\ncount = 50_000\n", 0);
    assert_eq!(crowded.key, "wisps.count");
    // What was undone is not done, though it cannot be.
    exact(
        &mut stylist,
        &asked(&format!("{CURLY}\n[[step]]\nwet = {{ where = {{ wisps = [99] }} }}\n"), 0),
    );
}
