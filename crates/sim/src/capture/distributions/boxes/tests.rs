use super::*;

fn by(groups: &[(&str, &[f64])]) -> ByValue {
    let groups = groups.iter().map(|(value, numbers)| ((*value).to_owned(), numbers.to_vec())).collect();
    ByValue { name: "path, m".into(), groups }
}

fn panels(results: &[ByValue]) -> Vec<Panel> {
    boxes("a sweep", "planner", results, Vec::new()).figure.panels
}

fn points(picture: &Picture, id: &str) -> Vec<Vec<Point2>> {
    let item = picture.items.iter().find(|item| item.id == id).unwrap_or_else(|| panic!("{id}"));
    match &item.drawing {
        Drawing::Polygon(corners) | Drawing::Polyline(corners) => vec![corners.clone()],
        Drawing::Region { outline, .. } => outline.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_box_goes_from_quartile_to_quartile_between_whiskers_at_the_ends() {
    let numbers: Vec<f64> = (0..=8).map(f64::from).collect();
    let panel = panels(&[by(&[("a", &numbers), ("b", &[4.0, 8.0])])]).remove(0);
    let picture = panel.picture;
    let x = |id: &str, line: usize, point: usize| points(&picture, id)[line][point].x;
    // a pixel of the axis for each unit, by the ends of the whiskers
    let (least, greatest) = (x("whiskers/0", 0, 0), x("whiskers/0", 1, 1));
    let unit = (greatest - least) / 8.0;
    let near = |x: f64, value: f64| (x - least - value * unit).abs() < 1e-9;
    assert!(near(x("box/0", 0, 0), 2.0) && near(x("box/0", 0, 1), 6.0) && near(x("median/0", 0, 0), 4.0));
    assert!(near(x("whiskers/0", 0, 1), 2.0) && near(x("whiskers/0", 1, 0), 6.0));
    // few runs are dots on the same axis, in a row below
    let dots = points(&picture, "dots/1");
    assert!(dots.len() == 2 && near(dots[0][0].x, 4.0) && near(dots[1][0].x, 8.0));
    assert!(dots[0][0].y < points(&picture, "box/0")[0].iter().map(|p| p.y).fold(f64::INFINITY, lesser));
    let within =
        |p: &Point2| (0.0..=picture.bounds.max.x).contains(&p.x) && (0.0..=picture.bounds.max.y).contains(&p.y);
    for id in ["box/0", "whiskers/0", "median/0", "dots/1", "axes"] {
        assert!(points(&picture, id).iter().flatten().all(within), "{id}");
    }
}

#[test]
fn a_figure_says_in_words_what_it_draws_and_leaves_out_what_no_run_has() {
    let results =
        [by(&[("a", &[1.0, 2.0, 4.0]), ("b", &[]), ("c", &[f64::INFINITY, 3.0])]), by(&[("a", &[]), ("b", &[])])];
    let captured = boxes("a sweep", "planner", &results, Vec::new());
    assert_eq!(captured.figure.panels.len(), 1);
    assert_eq!(
        captured.figure.description,
        "path, m by planner: a 2.000, 1.500 to 3.000, in 3 runs; b in no run; c 3.000 in one run."
    );
    let items = &captured.figure.panels[0].picture.items;
    assert!(items.iter().any(|item| item.id == "value/1"), "a value without any run has its row");
    let drawn = |row: &str| {
        items
            .iter()
            .filter(|item| ["dots", "box", "whiskers", "median"].iter().any(|of| item.id == format!("{of}/{row}")))
            .count()
    };
    assert_eq!(["0", "1", "2"].map(drawn), [1, 0, 1], "and nothing in it");
}

#[test]
fn long_words_are_cut_and_numbers_of_one_size_have_room() {
    let long = "a-planner-with-a-very-long-name";
    let picture = panels(&[by(&[(long, &[2.0; 9]), ("b", &[2.0])])]).remove(0).picture;
    let name = picture.items.iter().find(|item| item.id == "value/0").unwrap();
    let Drawing::Label { text, at, .. } = &name.drawing else { panic!("a label") };
    assert_eq!(text, "a-planner-with-a-very\u{2026}");
    let (median, axis) = (points_of_segment(&picture, "median/0"), points(&picture, "axes")[0].clone());
    let middle = 0.5 * (axis[1].x + axis[2].x);
    assert!((median - middle).abs() < 1e-9, "one value alone is in the middle");
    assert!(at.x < middle);
    for ends in [[-1.0e150, 1.0e150], [1.0, 1.0 + 1e-15]] {
        let picture = panels(&[by(&[("a", &ends)])]).remove(0).picture;
        assert!(points(&picture, "dots/0").iter().flatten().all(|p| p.x.is_finite() && p.y.is_finite()), "{ends:?}");
    }
}

fn points_of_segment(picture: &Picture, id: &str) -> f64 {
    points(picture, id)[0][0].x
}
