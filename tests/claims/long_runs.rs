//! Conserved quantities over a million steps.
//!
//! Guards the methods of `mechanics::integrators`.

use affinor::group::{Embedded, LieGroup, Se3, Sl2, So3, TranslationSplit};
use affinor::mechanics::integrators::kick::{FreeMotion, KickOrder};
use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use affinor::mechanics::systems::euler_poincare::{Free, Torque};
use affinor::mechanics::{
    BodyState, CommutatorFree, EulerPoincare, Inertia, Integrator, Kick, KinematicState, Magnus,
    MoserVeselov, MuntheKaas, PrescribedVelocity, Projected, SimoWong, State,
};
use affinor::{CanonicalConnection, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Matrix3, UnitQuaternion, Vector3, Vector6};

const MILLION: usize = 1_000_000;

/// The body of Hairer and Vilmart in axes that are not principal, and its metric.
fn body() -> (Inertia, Metric<f64>) {
    let axes = So3.exp(&Vector3::new(0.3, -0.8, 0.5)).to_rotation_matrix().into_inner();
    let matrix = axes * Matrix3::from_diagonal(&Vector3::new(0.6, 0.8, 1.0)) * axes.transpose();
    let matrix = (matrix + matrix.transpose()) * 0.5;
    let metric = Tensor::from_fn(3, [Down, Down], |[i, j]| matrix[(i, j)]).unwrap();
    let metric = Metric::new(So3.algebra().unwrap().labels(), metric).unwrap();
    (Inertia::new(&matrix).unwrap(), metric)
}

fn system<M: Torque<So3>>(metric: &Metric<f64>, torque: M) -> EulerPoincare<So3, M> {
    let connection = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    EulerPoincare::new(So3, &connection, metric, torque).unwrap()
}

/// The largest deviations of a run. For the energy: the relative error up to step 20 000 (`early`)
/// and in all (`most`). Then the deviation of the length of the quaternion, and the relative error
/// of the vertical spatial momentum.
#[derive(Debug)]
struct Strayed {
    early: f64,
    most: f64,
    length: f64,
    vertical: f64,
}

fn run<M: Torque<So3>>(
    method: &(impl Integrator<EulerPoincare<So3, M>> + ?Sized),
    system: &EulerPoincare<So3, M>,
    potential: impl Fn(&UnitQuaternion<f64>) -> f64,
    steps: usize,
) -> Strayed {
    let start = So3.exp(&Vector3::new(0.5, 0.2, 0.1));
    let start = system.state(0.0, start, &Vector3::new(3.0, 0.5, -0.9));
    let energy = |state: &State<So3>| system.energy(state) + potential(&state.element);
    let (first, mut state) = (energy(&start), start.clone());
    let mut strayed = Strayed { early: 0.0, most: 0.0, length: 0.0, vertical: 0.0 };
    for step in 0..steps {
        method.step(system, &mut state, 0.05).unwrap();
        strayed.length = strayed.length.max((state.element.norm() - 1.0).abs());
        if step % 7 == 0 {
            strayed.most = strayed.most.max((energy(&state) / first - 1.0).abs());
        }
        if step < 20_000 {
            strayed.early = strayed.most;
        }
    }
    strayed.vertical = (state.spatial.z / start.spatial.z - 1.0).abs();
    if potential(&start.element) == 0.0 {
        assert_eq!(state.spatial, start.spatial);
    }
    assert!(strayed.length < 2e-15, "{strayed:?}");
    strayed
}

#[test]
#[ignore = "long: up to a million steps"]
fn a_free_body_keeps_energy_and_momentum() {
    let (inertia, metric) = body();
    let system = system(&metric, Free);
    let methods: [(&str, &dyn Integrator<EulerPoincare<So3, Free>>); 4] = [
        ("DMV2", &MoserVeselov::new(&inertia, MoserVeselovOrder::Two)),
        ("DMV6", &MoserVeselov::new(&inertia, MoserVeselovOrder::Six)),
        ("DMV10", &MoserVeselov::new(&inertia, MoserVeselovOrder::Ten)),
        ("Simo-Wong", &SimoWong::new(&inertia)),
    ];
    for (name, method) in methods {
        let strayed = run(method, &system, |_| 0.0, MILLION);
        assert!(strayed.most < 5e-13, "{name}: {strayed:?}");
    }
}

/// Elements remain on the group and the momentum is conserved for methods that work on any group;
/// the energy drifts.
#[test]
#[ignore = "long: up to a million steps"]
fn methods_of_any_group_keep_the_momentum() {
    let (_, metric) = body();
    let system = system(&metric, Free);
    let methods: [(&dyn Integrator<EulerPoincare<So3, Free>>, f64); 3] =
        [(&MuntheKaas::RK4, 1e-3), (&Projected::RK4, 1e-3), (&CommutatorFree, 1e-3)];
    for (method, bound) in methods {
        let strayed = run(method, &system, |_| 0.0, MILLION / 5);
        assert!(strayed.most < bound && strayed.most > 1.1 * strayed.early, "{strayed:?}");
    }
}

#[test]
#[ignore = "long: up to a million steps"]
fn a_body_in_a_potential() {
    let (inertia, metric) = body();
    let centre = Vector3::new(0.1, -0.2, 0.3);
    let weight = move |_: f64, g: &UnitQuaternion<f64>, _: &Vector3<f64>| {
        centre.cross(&g.inverse_transform_vector(&Vector3::new(0.0, 0.0, -2.0)))
    };
    let potential = |g: &UnitQuaternion<f64>| 2.0 * (g * centre).z;
    let system = system(&metric, weight);
    let ten = FreeMotion::MoserVeselov(MoserVeselovOrder::Ten);
    for (order, motion, steps, bound) in [
        (KickOrder::Two, ten, MILLION, 5e-4),
        (KickOrder::Two, FreeMotion::Exact, MILLION / 5, 5e-4),
        (KickOrder::Four, ten, MILLION / 5, 4e-10),
        (KickOrder::Six, ten, MILLION / 5, 5e-13),
    ] {
        let strayed = run(&Kick::new(&inertia, order, motion), &system, potential, steps);
        let Strayed { early, most, vertical, .. } = strayed;
        assert!(most < bound && vertical < 1e-14, "{order:?} {motion:?}: {strayed:?}");
        assert!(most < 1.1 * early + 5e-13, "{order:?} {motion:?}: {strayed:?}");
    }
    // symmetric but not symplectic: the energy performs a random walk
    let strayed = run(&SimoWong::new(&inertia), &system, potential, MILLION / 5);
    assert!(strayed.most < 1e-3 && strayed.vertical < 1e-14, "{strayed:?}");
}

/// Elements of rigid motions and of SL(2) stay on their groups.
#[test]
#[ignore = "long: up to a million steps"]
fn elements_stay_on_the_group() {
    fn ends<G: Embedded + TranslationSplit>(group: G, velocity: &G::Vector) -> [G::Element; 3] {
        let n = group.dimension();
        let entry = |[i, j]: [usize; 2]| if i == j { 1.0 + 0.5 * i as f64 } else { 0.05 };
        let algebra = group.algebra().unwrap();
        let metric = Tensor::from_fn(n, [Down, Down], entry).unwrap();
        let metric = Metric::new(algebra.labels(), metric).unwrap();
        let connection = Connection::canonical(&algebra, CanonicalConnection::Plus);
        let system = EulerPoincare::free(group, &connection, &metric).unwrap();
        let methods: [&dyn Integrator<EulerPoincare<G, Free>>; 3] =
            [&CommutatorFree, &MuntheKaas::RK4, &Projected::RK4];
        methods.map(|method| {
            let mut state = system.state(0.0, system.group().identity(), velocity);
            for _ in 0..MILLION / 10 {
                method.step(&system, &mut state, 0.01).unwrap();
            }
            state.element
        })
    }
    for pose in ends(Se3, &Vector6::new(0.5, -0.3, 0.6, 0.4, 0.2, -0.5)) {
        assert!((pose.rotation.norm() - 1.0).abs() < 2e-15);
    }
    let mut place = KinematicState { time: 0.0, element: So3.identity() };
    let wheel =
        PrescribedVelocity { group: So3, velocity: |t: f64| Vector3::new(t.sin(), 0.3, t.cos()) };
    for _ in 0..MILLION / 10 {
        Magnus::Four.step(&wheel, &mut place, 0.01).unwrap();
    }
    assert!((place.element.norm() - 1.0).abs() < 2e-15);
    let velocity = Vector3::new(0.2, -0.5, 0.1); // a turn and not a stretch
    for turned in ends(Sl2, &velocity) {
        assert!((turned.determinant() - 1.0).abs() < 1e-13);
    }
}

/// Sums are compensated for rounding errors. Without this both errors would be 1e-13 to 2e-13.
#[test]
#[ignore = "long: up to a million steps"]
fn compensated_sums() {
    let inertia = Inertia::diagonal(&Vector3::new(0.6, 0.8, 1.0)).unwrap();
    let momentum = Vector3::new(1.8, 0.4, -0.9);
    let start = BodyState { attitude: UnitQuaternion::identity(), momentum };
    for order in [MoserVeselovOrder::Two, MoserVeselovOrder::Six, MoserVeselovOrder::Ten] {
        let end = MoserVeselov::new(&inertia, order).steps(&start, 0.05, MILLION).unwrap();
        let off = (end.space_momentum() - momentum).norm() / momentum.norm();
        let energy = inertia.energy(&end.momentum) / inertia.energy(&momentum) - 1.0;
        assert!(off < 4e-14 && energy.abs() < 4e-14, "{order:?}: {off:e} {energy:e}");
        assert!((end.attitude.norm() - 1.0).abs() < 1e-15);
    }
}
