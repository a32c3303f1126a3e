//! Captures: asked for by button and key, written beside the window, read back.

use std::path::Path;

use super::*;
use crate::window::desktop::capture::{Capturing, capture, check, follow};
use crate::window::desktop::clipboard::Clipboard;
use crate::window::ui::{CaptureOrder, Notice};

fn ui(harness: &Harness<'_, Lab>) -> crate::window::ui::UiState {
    harness.state().app.world().resource::<Interface>().0.clone()
}

/// What the form asked for, once a file is to be chosen.
fn order(harness: &mut Harness<'_, Lab>) -> CaptureOrder {
    click(harness, "Choose a file");
    assert!(!ui(harness).capture.open);
    let mut asked = harness.state_mut().app.world_mut().resource_mut::<Messages<SessionCommand>>();
    let last = asked.drain().last();
    let Some(SessionCommand::Capture(order)) = last else { panic!("{last:?}") };
    order
}

/// Captures to a file as the window does, and waits for the notice.
fn done(harness: &mut Harness<'_, Lab>, order: &CaptureOrder, path: &Path) -> Notice {
    let world = harness.state_mut().app.world_mut();
    world.init_resource::<Capturing>();
    capture(world, order, path);
    while harness.state().app.world().resource::<Interface>().0.working.is_some() {
        std::thread::sleep(Duration::from_millis(5));
        follow(harness.state_mut().app.world_mut());
    }
    ui(harness).notice().cloned().expect("something is said")
}

fn png_notes(path: &Path) -> Vec<(String, String)> {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let reader = png::Decoder::new(file).read_info().unwrap();
    reader.info().uncompressed_latin1_text.iter().map(|t| (t.keyword.clone(), t.text.clone())).collect()
}

#[test]
fn the_dashboard_is_captured_with_seed_and_digest() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = lab(WIDE);
    harness.run_steps(80);
    pause(&mut harness);
    click(&mut harness, "Capture");
    harness.get_by_label("seed, digest and tick in its metadata");
    click(&mut harness, "column, 640");
    click(&mut harness, "1\u{d7}");
    let mut asked = order(&mut harness);
    assert_eq!((asked.width, asked.scale), (640, 1));
    let path = folder.path().join("d.png");
    let said = done(&mut harness, &asked, &path);
    assert!(!said.is_error && said.text == "d.png: captured", "{said:?}");
    // the same digest as the run that is saved
    let log = folder.path().join("d.mcap");
    save_run(harness.state_mut().app.world_mut(), &log);
    let digest = Log::read_mcap(&std::fs::read(&log).unwrap()).unwrap().log.digest().unwrap().to_string();
    let tick = harness.state().transport().tick;
    let notes = png_notes(&path);
    for (key, text) in [("Seed", "2005"), ("Digest", &digest), ("Tick", &tick.to_string())] {
        assert!(notes.contains(&(key.into(), text.into())), "{key} {text}: {notes:?}");
    }
    // and over a span of ticks
    click(&mut harness, "Capture");
    click(&mut harness, "GIF");
    harness.get_by_label_contains("of the run; seed, digest and ticks in its comment");
    harness.get_by_label("GIF: from tick");
    asked = order(&mut harness);
    assert_eq!((asked.span.from, asked.span.to), (0, tick));
    asked.span = motion_lab_sim::capture::CaptureSpan { from: 4, to: 12, every: 4 };
    let path = folder.path().join("d.gif");
    let said = done(&mut harness, &asked, &path);
    assert!(!said.is_error, "{said:?}");
    let bytes = std::fs::read(&path).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains(&format!("Seed: 2005; Digest: {digest}; Tick: 4 to 12")));
    let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let mut pictures = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!(frame.delay, 20);
        pictures.push(frame.buffer.to_vec());
    }
    assert!(pictures.len() == 3 && pictures[0] != pictures[1] && pictures[1] != pictures[2]);
}

#[test]
fn every_widget_is_captured_as_it_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = lab(WIDE);
    harness.run_steps(20);
    for (word, key, holds) in [
        ("Query", "witness", "Configuration: T2(Tn(["),
        ("Space", "the tip's reach", "Configuration: T2(Tn(["),
        ("Atlas", "Measure", "World: Apartment "),
    ] {
        click(&mut harness, word);
        click(&mut harness, key);
        harness.run_steps(10);
        harness.key_press(Key::I);
        harness.run_steps(3);
        click(&mut harness, "SVG");
        harness.get_by_label("the world's content hash and the configuration in its metadata");
        let asked = order(&mut harness);
        let path = folder.path().join(format!("{word}.svg"));
        let said = done(&mut harness, &asked, &path);
        assert!(!said.is_error, "{said:?}");
        let svg = std::fs::read_to_string(&path).unwrap();
        assert!(svg.contains(&format!("; {holds}")), "{word}: {}", svg.lines().nth(3).unwrap_or(""));
        let shown = match word {
            "Query" => svg.contains(">a* on the robot<") && svg.contains(">close up<"),
            "Space" => svg.contains(">the outer circle of the annulus<") && svg.contains(">proven free<"),
            _ => svg.contains("cells of 0.25 m"),
        };
        assert!(shown, "{word}");
    }
}

/// Copies the picture in front by the form, with a clipboard that takes pictures so.
fn copied(harness: &mut Harness<'_, Lab>, clipboard: Clipboard) -> Notice {
    harness.state_mut().app.world_mut().insert_resource(clipboard);
    harness.state_mut().app.init_resource::<Capturing>();
    click(harness, "Capture");
    click(harness, "column, 640");
    click(harness, "1\u{d7}");
    click(harness, "Copy picture");
    assert!(!ui(harness).capture.open);
    while ui(harness).working.is_some() {
        std::thread::sleep(Duration::from_millis(5));
        follow(harness.state_mut().app.world_mut());
    }
    ui(harness).notice().cloned().expect("something is said")
}

#[test]
fn the_picture_in_front_is_copied_as_it_would_be_captured() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = lab(WIDE);
    harness.run_steps(20);
    pause(&mut harness);
    for widget in ["Drive", "Atlas"] {
        click(&mut harness, widget);
        let (give, take) = std::sync::mpsc::channel();
        let clipboard = Clipboard::by(move |image| give.send(image.clone()).map_err(|error| error.to_string()));
        let said = copied(&mut harness, clipboard);
        assert_eq!((said.text.as_str(), said.is_error), ("copied", false));
        let image = take.try_recv().unwrap();
        assert!(take.try_recv().is_err(), "one picture");
        let path = folder.path().join(format!("{widget}.png"));
        let order = ui(&harness).capture.order;
        assert!(!done(&mut harness, &order, &path).is_error);
        let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!((image.width, image.height), (reader.info().width, reader.info().height));
        assert!(image.width == 640 && image.rgb == pixels, "{widget}: the same pixels as in the file");
    }
    // the menu copies at once
    interface_mut(&mut harness).dismiss_notice();
    harness.state_mut().app.world_mut().insert_resource(Clipboard::by(|_| Ok(())));
    click(&mut harness, "Copy picture");
    while ui(&harness).working.is_some() {
        std::thread::sleep(Duration::from_millis(5));
        follow(harness.state_mut().app.world_mut());
    }
    assert_eq!(ui(&harness).notice().unwrap().text, "copied");
    let said = copied(&mut harness, Clipboard::by(|_| Err("there is no clipboard".into())));
    assert_eq!((said.text.as_str(), said.is_error), ("not copied: there is no clipboard", true));
}

#[test]
fn what_does_not_move_or_is_not_in_the_run_is_refused_in_place() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = lab(WIDE);
    harness.run_steps(40);
    click(&mut harness, "Query");
    click(&mut harness, "Capture");
    click(&mut harness, "GIF");
    harness.get_by_label_contains("query anatomy is one frozen scene");
    click(&mut harness, "Choose a file");
    assert!(ui(&harness).capture.open, "the button does nothing");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(!ui(&harness).capture.open);
    // the configuration space moves with the run's arm
    click(&mut harness, "Space");
    click(&mut harness, "Capture");
    let mut asked = order(&mut harness);
    asked.span = motion_lab_sim::capture::CaptureSpan { from: 0, to: 8, every: 8 };
    (asked.width, asked.scale) = (640, 1);
    let config = harness.state().app.world().resource::<RunConfig>().config().clone();
    assert!(check(&config, &ui(&harness), &asked).is_ok());
    let path = folder.path().join("s.gif");
    let said = done(&mut harness, &asked, &path);
    assert!(!said.is_error, "{said:?}");
    let alone =
        motion_lab_sim::tour::TourConfig { worlds: vec![motion_lab_core::worlds::World::lot()], ..(*config).clone() };
    let error = check(&alone, &ui(&harness), &asked).unwrap_err().to_string();
    assert!(error.contains("the run has no world Workbench"), "{error}");
    // a file that can't be written is reported with its path, and nothing is left behind
    let nowhere = folder.path().join("none").join("x.png");
    let said = done(&mut harness, &asked, &nowhere);
    assert!(said.is_error && said.text.contains("none") && said.text.contains("can't be written"), "{said:?}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_capture_under_way_is_shown_and_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = lab(WIDE);
    harness.run_steps(80);
    pause(&mut harness);
    click(&mut harness, "Capture");
    click(&mut harness, "GIF");
    let asked = order(&mut harness);
    let path = folder.path().join("d.gif");
    let world = harness.state_mut().app.world_mut();
    world.init_resource::<Capturing>();
    capture(
        world,
        &CaptureOrder { span: motion_lab_sim::capture::CaptureSpan { every: 1, ..asked.span }, ..asked },
        &path,
    );
    harness.run_steps(2);
    harness.get_by_label_contains("d.gif: ");
    click(&mut harness, "Stop");
    while ui(&harness).working.is_some() {
        std::thread::sleep(Duration::from_millis(5));
        follow(harness.state_mut().app.world_mut());
    }
    harness.run_steps(2);
    harness.get_by_label("d.gif: stopped, no file was written");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
