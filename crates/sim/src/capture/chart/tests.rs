use super::*;

#[test]
fn a_dip_of_one_tick_is_drawn_among_a_million() {
    let mut points: Vec<Point2> =
        (0..1_000_000).map(|i| Point2::new(f64::from(i) / 2000.0, 100.0 + f64::from(i % 7))).collect();
    points[400_001].y = 3.0;
    points[700_003].y = 300.0;
    let thin = thinned(&points);
    assert!(thin.len() <= 4 * 500, "{}", thin.len());
    let has = |i: usize| thin.contains(&points[i]);
    assert!(has(0) && has(400_001) && has(700_003) && has(999_999));
    assert!(thin.windows(2).all(|pair| pair[0].x <= pair[1].x));
    assert_eq!(thinned(&points[..1]), points[..1]);
}

#[test]
fn a_chart_is_drawn_pixel_for_pixel_with_its_values_where_the_axes_say() {
    let line = |name: &str, pieces: &[&[[f64; 2]]]| PlotLine {
        name: name.into(),
        pieces: pieces.iter().map(|piece| piece.to_vec()).collect(),
        contacts: Vec::new(),
    };
    let lines = vec![line("a", &[&[[0.0, 0.0], [5.0, 10.0]], &[[10.0, 5.0]]]), line("b", &[])];
    let chart = PlotChart {
        up: "height, m",
        across: "time, s",
        span: [0.0, 10.0],
        only: None,
        values: PlotValues::FromZero,
        lines,
    };
    for width in [200.0, 640.0, 1280.0] {
        let picture = chart.picture(width - 56.0);
        assert_eq!(motion_lab_core::picture::Figure::of(picture.clone()).px_per_metre(width), [1.0], "{width}");
        let find = |id: &str| &picture.items.iter().find(|i| i.id == id).unwrap().drawing;
        let Drawing::Region { outline, .. } = find("line/a") else { panic!("lines") };
        let Drawing::Polyline(axes) = find("axes") else { panic!("a line") };
        let (origin, right) = (axes[1], axes[2].x);
        assert_eq!(outline[0][0], origin, "0 at 0 s is the corner");
        assert!((outline[0][1].x - 0.5 * (origin.x + right)).abs() < 1e-9, "5 s is the middle of 10 s");
        let top = picture.bounds.max.y;
        assert!(outline[0][1].y > origin.y + 0.8 * (0.4 * width - 60.0) && outline[0][1].y < top, "up is up");
        assert_eq!(outline[1].len(), 2, "a value alone is a dot");
        assert!((outline[1][0].y - origin.y - 0.5 * (outline[0][1].y - origin.y)).abs() < 1e-9);
        let low = picture.items.iter().filter(|i| i.id.starts_with("grid/")).count();
        assert!(low >= 2, "{low} marks");
    }
}

#[test]
fn contacts_are_shaded_from_their_beginning_to_their_end_and_belong_to_their_lines() {
    let line = |name: &str, contacts: &[[f64; 2]]| PlotLine {
        name: name.into(),
        pieces: vec![(0..=4).map(|x| [f64::from(x), 1.0]).collect(), vec![[8.0, 2.0]]],
        contacts: contacts.to_vec(),
    };
    let chart = |lines| {
        PlotChart { up: "u", across: "t", span: [0.0, 10.0], only: None, values: PlotValues::FromZero, lines }
            .picture(640.0)
    };
    let picture = chart(vec![line("a", &[[1.0, 3.0], [8.0, 9.0]]), line("b", &[[2.0, 4.0], [10.0, 10.5]])]);
    let find = |id: &str| picture.items.iter().find(|i| i.id == id);
    let Drawing::Region { pieces, .. } = &find("contacts").unwrap().drawing else { panic!("columns") };
    let Drawing::Polyline(axes) = &find("axes").unwrap().drawing else { panic!("a line") };
    let (left, right, bottom, top) = (axes[1].x, axes[2].x, axes[1].y, axes[0].y);
    let at = |x: f64| left + 0.1 * x * (right - left);
    let ends: Vec<[f64; 2]> = pieces.iter().map(|column| [column[0].x, column[1].x]).collect();
    // 1 to 4 is one column of two robots; what begins at the end keeps a pixel
    let expected = [[at(1.0), at(4.0)], [at(8.0), at(9.0)], [right - 1.0, right]];
    let apart = ends.iter().flatten().zip(expected.iter().flatten()).map(|(a, b)| (a - b).abs());
    assert!(ends.len() == 3 && apart.fold(0.0, greater) < 1e-9, "{ends:?}, not {expected:?}");
    assert!(pieces.iter().all(|column| column[0].y == bottom && column[2].y == top), "as high as the axes");
    let beneath = |id: &str| match &find(id).unwrap().drawing {
        Drawing::Region { outline, .. } => outline.iter().map(|l| [l[0].x, l[l.len() - 1].x]).collect::<Vec<_>>(),
        _ => panic!("lines"),
    };
    let near = |found: Vec<[f64; 2]>, expected: &[[f64; 2]]| {
        let apart = found.iter().flatten().zip(expected.iter().flatten()).map(|(x, e)| (x - at(*e)).abs());
        assert!(found.len() == expected.len() && apart.fold(0.0, greater) < 1e-9, "{found:?}");
    };
    // a value at the end of a contact is out of it
    near(beneath("contact/a"), &[[1.0, 2.0], [8.0, 8.0]]);
    near(beneath("contact/b"), &[[2.0, 3.0]]);
    let order = |id: &str| picture.items.iter().position(|i| i.id == id);
    assert!(order("contacts") < order("line/a") && order("contact/b") < order("line/a"), "lines are above");
    assert!(find("legend/contacts").is_some() && find("legend/in contact/name").is_some());
    let free = chart(vec![line("a", &[])]);
    assert!(free.items.iter().all(|i| i.role != CONTACT && !i.id.contains("contact")), "none without any");
}
