//! In a run under way, what others write, insert, remove or despawn is put back and refused aloud.

use bevy::prelude::{Entity, Query, Update, With};
use motion_lab_core::collision::Scene;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{RUSTY, Rusty};
use motion_lab_core::worlds::ObstacleKind;
use motion_lab_sim::simulation::{
    Configuration, Contacts, Control, Cut, Door, DrawnTour, DriveMode, MountedOn, ObstacleOf, ObstacleShape, OwnState,
    Placement, PreviousConfiguration, Refusals, ResidesIn, RobotId, RobotModel, Scan, SensorModel, SensorMount,
    SensorName, SensorRoster, Slip, TickMotion, TransportCommand, WorldScene,
};

use super::start::find_obstacle;
use super::*;

/// Runs ten ticks, lets `change` at the world, looks what is refused, and fails unless the run goes on as it would
/// have.
#[track_caller]
pub(crate) fn refusals_of(change: impl FnOnce(&mut Ecs)) -> Vec<String> {
    let mut app = app();
    drive(&mut app, "A", (100, 20));
    steps(app.world_mut(), 10);
    let before = frame(app.world());
    change(app.world_mut());
    motion_lab_sim::simulation::settle(app.world_mut());
    assert_eq!(frame(app.world()).digest(), before.digest());
    assert_agrees(app.world_mut());
    let said = refused(app.world_mut());
    steps(app.world_mut(), 10);
    assert_agrees(app.world_mut());
    assert_recorded(app.world());
    assert_eq!(refused(app.world_mut()), [""; 0], "once only");
    said
}

#[track_caller]
fn assert_put_back(change: impl FnOnce(&mut Ecs), thing: &str, components: &[&str]) {
    let said = refusals_of(change);
    let mut expected: Vec<&str> = components.to_vec();
    for text in &said {
        assert!(text.starts_with(&format!("{thing} (entity ")), "{text}");
        let found = expected.iter().position(|component| text.contains(&format!("): {component} was changed past")));
        expected.remove(found.unwrap_or_else(|| panic!("{text}")));
    }
    assert!(expected.is_empty(), "not said: {expected:?} in {said:?}");
}

fn a(world: &Ecs) -> Entity {
    robot(world, "A")
}

#[test]
fn values_that_are_written_are_put_back() {
    let rover = "robot \"A\"";
    assert_put_back(
        |world| world.get_mut::<Configuration<Rusty>>(a(world)).unwrap().0.x += 0.1,
        rover,
        &["Configuration<Rusty>"],
    );
    assert_put_back(
        |world| world.get_mut::<DriveMode<Rusty>>(a(world)).unwrap().channels[0] = -128,
        rover,
        &["DriveMode<Rusty>"],
    );
    assert_put_back(
        |world| world.get_mut::<DriveMode<Rusty>>(a(world)).unwrap().refusals += 1,
        rover,
        &["DriveMode<Rusty>"],
    );
    assert_put_back(
        |world| {
            world.entity_mut(a(world)).insert((Control::<Rusty>::default(), Contacts::<Rusty>::default()));
            world.entity_mut(a(world)).insert(OwnState::<Rusty>::default());
        },
        rover,
        &["Control<Rusty>", "Contacts<Rusty>", "OwnState<Rusty>"],
    );
    // values of one robot on another
    let two = refusals_of(|world| {
        let [a, b] = ["A", "B"].map(|name| robot(world, name));
        let mut all = world.query::<(&mut PreviousConfiguration<Rusty>, &mut OwnState<Rusty>, &mut Control<Rusty>)>();
        let [mut a, mut b] = all.get_many_mut(world, [a, b]).unwrap();
        std::mem::swap(&mut *a.0, &mut *b.0);
        std::mem::swap(&mut *a.1, &mut *b.1);
        std::mem::swap(&mut *a.2, &mut *b.2);
    });
    assert_eq!(two.len(), 6, "{two:?}");
}

#[test]
fn each_value_that_is_written_in_place_is_put_back() {
    type Write = fn(&mut bevy::prelude::EntityWorldMut);
    let writes: [(&str, Write); 4] = [
        ("Control<Rusty>", |e| *e.get_mut::<Control<Rusty>>().unwrap() = Control::default()),
        ("Contacts<Rusty>", |e| *e.get_mut::<Contacts<Rusty>>().unwrap() = Contacts::default()),
        ("OwnState<Rusty>", |e| *e.get_mut::<OwnState<Rusty>>().unwrap() = OwnState::default()),
        ("DriveMode<Rusty>", |e| *e.get_mut::<DriveMode<Rusty>>().unwrap() = DriveMode::default()),
    ];
    for (component, write) in writes {
        let mut app = app();
        drive(&mut app, "A", (128, 0));
        // straight on it meets the other rover, and has values of every sort that are not those of a start
        while frame(app.world()).robots[0].contacts == 0 {
            assert!(frame(app.world()).tick < 100);
            step(app.world_mut());
        }
        let e = a(app.world());
        let before = format!("{:?}", values(app.world(), e));
        write(&mut app.world_mut().entity_mut(e));
        assert_ne!(format!("{:?}", values(app.world(), e)), before, "{component}");
        motion_lab_sim::simulation::settle(app.world_mut());
        assert_eq!(format!("{:?}", values(app.world(), e)), before, "{component}");
        let said = refused(app.world_mut());
        assert!(said.len() == 1 && said[0].contains(&format!("): {component} was changed past")), "{said:?}");
        steps(app.world_mut(), 3);
        assert_recorded(app.world());
    }
}

/// The values of a rover.
type Values<'a> = (&'a Control<Rusty>, &'a Contacts<Rusty>, &'a OwnState<Rusty>, &'a DriveMode<Rusty>);

fn values(world: &Ecs, e: Entity) -> Values<'_> {
    let e = world.entity(e);
    (e.get().unwrap(), e.get().unwrap(), e.get().unwrap(), e.get().unwrap())
}

#[test]
fn a_negative_zero_is_put_back_too() {
    let mut app = app();
    // a rover that stands where it started
    drive(&mut app, "A", (0, 0));
    steps(app.world_mut(), 3);
    let (a, before) = (a(app.world()), frame(app.world()));
    let q = &mut app.world_mut().get_mut::<Configuration<Rusty>>(a).unwrap().0;
    assert_eq!((q.x.to_bits(), q.theta.to_bits()), (0, 0));
    (q.x, q.theta) = (-0.0, -0.0);
    motion_lab_sim::simulation::settle(app.world_mut());
    assert_agrees(app.world_mut());
    assert_eq!(frame(app.world()).digest(), before.digest());
    steps(app.world_mut(), 20);
    assert_recorded(app.world());
}

#[test]
fn what_is_removed_or_replaced_is_put_back() {
    type Change = fn(&mut bevy::prelude::EntityWorldMut);
    let changes: [(&str, Change); 16] = [
        ("Configuration<Rusty>", |e| _ = e.remove::<Configuration<Rusty>>()),
        ("PreviousConfiguration<Rusty>", |e| _ = e.remove::<PreviousConfiguration<Rusty>>()),
        ("Control<Rusty>", |e| _ = e.remove::<Control<Rusty>>()),
        ("Contacts<Rusty>", |e| _ = e.remove::<Contacts<Rusty>>()),
        ("DriveMode<Rusty>", |e| _ = e.remove::<DriveMode<Rusty>>()),
        ("OwnState<Rusty>", |e| _ = e.remove::<OwnState<Rusty>>()),
        ("DrawnTour<Rusty>", |e| _ = e.remove::<DrawnTour<Rusty>>()),
        ("TickMotion<Rusty>", |e| _ = e.remove::<TickMotion<Rusty>>()),
        ("Cut<Rusty>", |e| _ = e.remove::<Cut<Rusty>>()),
        ("RobotModel<Rusty>", |e| _ = e.remove::<RobotModel<Rusty>>()),
        ("RobotModel<Rusty>", |e| _ = e.insert(RobotModel(Rusty { body_radius: 0.5, ..RUSTY }))),
        ("RobotId", |e| _ = e.insert(RobotId(1))),
        ("RobotName", |e| _ = e.insert(named("B", "rusty"))),
        ("ResidesIn", |e| _ = e.remove::<ResidesIn>()),
        ("Slip", |e| _ = e.insert(Slip(Stream::new(Seed(0), "other")))),
        ("RobotOps", |e| _ = e.remove::<motion_lab_sim::simulation::RobotOps>()),
    ];
    for (component, change) in changes {
        assert_put_back(|world| change(&mut world.entity_mut(a(world))), "robot \"A\"", &[component]);
    }
    // everything at once
    let said = refusals_of(|world| _ = world.entity_mut(a(world)).clear());
    assert!(said.iter().filter(|text| text.starts_with("robot \"A\" (entity ")).count() >= 15, "{said:?}");
    // the car is none, in whatever is given to it
    let said = refusals_of(|world| {
        let c = robot(world, "C");
        world.entity_mut(c).insert((RobotModel(RUSTY), Configuration::<Rusty>(Pose2::IDENTITY)));
    });
    assert!(!said.is_empty());
}

#[test]
fn what_is_despawned_comes_back_and_what_is_spawned_is_no_part_of_the_run() {
    let gone = "it was despawned past the run's commands, and is back as another entity";
    let said = refusals_of(|world| _ = world.despawn(a(world)));
    assert!(said[0].starts_with("robot \"A\" (entity ") && said[0].ends_with(gone), "{said:?}");
    assert!(said.iter().any(|text| text.starts_with("sensor \"\" of robot \"A\"")), "its sensor went along: {said:?}");
    let said = refusals_of(|world| {
        let yard = world.resource::<Roster>().worlds()[0];
        world.despawn(yard);
    });
    for thing in
        ["world \"yard\"", "robot \"A\"", "robot \"C\"", "obstacle \"post\" in world \"yard\"", "sensor \"\" of"]
    {
        assert!(said.iter().any(|text| text.starts_with(thing) && text.ends_with(gone)), "{thing}: {said:?}");
    }
    let said = refusals_of(|world| {
        let yard = world.resource::<Roster>().worlds()[0];
        let q = Configuration::<Rusty>(Pose2::new(0.5, 0.5, 0.0));
        world.spawn((RobotModel(RUSTY), q, named("new", "rusty"), ResidesIn(yard)));
        let shape = ObstacleShape { name: "bar".into(), kind: ObstacleKind::Solid, pieces: vec![] };
        world.spawn((shape, ObstacleOf(yard)));
        let fan = SensorModel::from(motion_lab_core::sensors::RangeSensor { n_rays: 5, max_range: 2.0 });
        world.spawn((fan, MountedOn(a(world))));
    });
    let taken_off = "it came after tick 0, when a run's entities are fixed: its";
    for (text, (thing, component)) in said.iter().zip([
        ("robot \"new\"", "RobotModel<Rusty> is taken off"),
        ("obstacle \"bar\"", "ObstacleShape is taken off"),
        ("sensor \"\"", "SensorModel is taken off"),
    ]) {
        assert!(text.starts_with(thing) && text.contains(taken_off) && text.ends_with(component), "{text}");
    }
    assert_eq!(said.len(), 3);
}

#[test]
fn obstacles_doors_worlds_and_sensors_are_put_back() {
    let post = "obstacle \"post\" in world \"yard\"";
    let on = |name: &'static str, change: fn(&mut bevy::prelude::EntityWorldMut)| {
        move |world: &mut Ecs| {
            let entity = find_obstacle(world, name);
            change(&mut world.entity_mut(entity));
        }
    };
    assert_put_back(on("post", |e| _ = e.remove::<ObstacleOf>()), post, &["ObstacleOf"]);
    assert_put_back(on("post", |e| _ = e.remove::<ObstacleShape>()), post, &["ObstacleShape"]);
    assert_put_back(on("post", |e| _ = e.insert(Door)), post, &["Door"]);
    let aside = Placement { present: true, pose: Pose2::new(1.0, 0.0, 0.0) };
    assert_put_back(
        move |world| {
            let post = find_obstacle(world, "post");
            world.entity_mut(post).insert(aside);
        },
        post,
        &["Placement"],
    );
    assert_put_back(
        |world| {
            let (post, bench) = (find_obstacle(world, "post"), world.resource::<Roster>().worlds()[1]);
            world.entity_mut(post).insert(ObstacleOf(bench));
        },
        post,
        &["ObstacleOf"],
    );
    let gate = "obstacle \"gate\" in world \"yard\"";
    assert_put_back(on("gate", |e| _ = e.remove::<Door>()), gate, &["Door"]);
    assert_put_back(on("gate", |e| _ = e.insert(Placement::default())), gate, &["Placement"]);
    assert_put_back(
        |world| {
            let yard = world.resource::<Roster>().worlds()[0];
            world.entity_mut(yard).insert(WorldScene(std::sync::Arc::new(Scene::empty(config().worlds[0].bounds))));
        },
        "world \"yard\"",
        &["WorldScene"],
    );
    let sensor = |world: &Ecs| world.resource::<SensorRoster>().entities().next().unwrap();
    let name = "sensor \"\" of robot \"A\"";
    assert_put_back(
        |world| _ = world.entity_mut(sensor(world)).insert(SensorMount(Pose2::new(1.0, 0.0, 0.0))),
        name,
        &["SensorMount"],
    );
    assert_put_back(|world| _ = world.entity_mut(sensor(world)).insert(SensorName("x".into())), name, &["SensorName"]);
    assert_put_back(|world| _ = world.entity_mut(sensor(world)).remove::<Scan>(), name, &["Scan"]);
    assert_put_back(|world| *world.get_mut::<Scan>(sensor(world)).unwrap() = Scan::default(), name, &["Scan"]);
    assert_put_back(
        |world| {
            let b = robot(world, "B");
            world.entity_mut(sensor(world)).insert(MountedOn(b));
        },
        name,
        &["MountedOn"],
    );
}

#[test]
fn what_is_refused_is_taken_back_at_once_and_takes_no_effect_after_a_seek() {
    let mut app = app();
    steps(app.world_mut(), 10);
    let (post, gate) = (find_obstacle(app.world_mut(), "post"), find_obstacle(app.world_mut(), "gate"));
    let world = app.world_mut();
    world.entity_mut(gate).insert(Placement::default());
    assert!(!world.get::<Placement>(gate).unwrap().present);
    world.despawn(post);
    find_obstacle(world, "post");
    assert_eq!(refused(world).len(), 2);
    for to in [4, 0, 20, 10] {
        send(&mut app, TransportCommand::Seek(to));
        assert_agrees(app.world_mut());
        assert_recorded(app.world());
    }
    assert!(refused(app.world_mut()).is_empty());
}

#[test]
fn a_system_that_writes_in_every_update_changes_no_bit() {
    let mut app = motion_lab_sim::simulation::headless_app();
    app.insert_resource(bevy::time::TimeUpdateStrategy::ManualDuration(std::time::Duration::from_millis(50)));
    start_run(app.world_mut(), config(), Seed(7)).unwrap();
    // from the first tick on
    steps(app.world_mut(), 1);
    app.world_mut().resource_mut::<motion_lab_sim::simulation::Transport>().playback =
        motion_lab_sim::simulation::Playback::Playing;
    let tamper = |mut rovers: Query<(&mut Configuration<Rusty>, &mut DriveMode<Rusty>), With<RobotId>>| {
        for (mut q, mut mode) in &mut rovers {
            q.0.x += 0.25;
            mode.channels = [128, 128];
        }
    };
    app.add_systems(Update, tamper);
    (0..30).for_each(|_| app.update());
    assert!(frame(app.world()).tick > 20);
    assert_agrees(app.world_mut());
    assert_recorded(app.world());
    // two rovers, two components, every update
    let said = refused(app.world_mut());
    assert!(said.len() >= 4 && said.iter().all(|text| text.contains("<Rusty> was changed past")), "{said:?}");
}

#[test]
fn a_command_that_no_script_could_hold_is_counted_with_its_reason() {
    let mut app = app();
    drive(&mut app, "nobody", (1, 1));
    drive(&mut app, "A", (129, 0));
    assert_eq!(refused(app.world_mut()), ["there is no robot \"nobody\"", "channel 129: it must be in -128 to 128"]);
    let refusals = app.world().resource::<Refusals>();
    assert_eq!(
        (refusals.count(), refusals.first().unwrap().to_string()),
        (2, "there is no robot \"nobody\"".to_owned())
    );
}

#[test]
fn what_is_added_is_no_more_once_its_tick_is_forgotten() {
    use motion_lab_sim::run::{Quantized, WorldChange};
    use motion_lab_sim::simulation::WorldCommand;
    let mut app = app();
    steps(app.world_mut(), 5);
    let of_world = |change| RunCommand::from(WorldCommand { world: "yard".into(), change });
    let at = Quantized(1 << 20);
    // a change of a looping run forgets what was to come with the next tick
    let add = WorldChange::Add { name: "added".into(), points: vec![(at, at)], radius: Quantized(1 << 17) };
    for command in
        [of_world(add), TransportCommand::SetLooping(true).into(), of_world(WorldChange::Close("gate".into()))]
    {
        app.world_mut().write_message(command);
    }
    app.update();
    assert_agrees(app.world_mut());
    let script = motion_lab_sim::simulation::recipe(app.world()).unwrap().script;
    assert_eq!(script.changes.iter().map(|c| c.change.name()).collect::<Vec<_>>(), ["gate"]);
    steps(app.world_mut(), 3);
    assert_recorded(app.world());
}
