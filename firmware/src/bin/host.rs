//! The controller on the host: reads a job from standard input or the file that is named, prints the samples as the chip does.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[cfg(not(target_os = "none"))]
fn main() {
    use feature_sampling::sampling::Sample;
    use plotter::*;

    struct Print;
    impl Listener for Print {
        fn phase(&mut self, _: u32) {}
        fn before_step(&mut self) {}
        fn after_step(&mut self) {}
        fn sample(&mut self, s: &Sample<f32>) {
            let [t, x, y, lfs] = [s.at.t, s.point.x, s.point.y, s.lfs].map(f32::to_bits);
            println!("s {:08x} {:08x} {t:08x} {x:08x} {y:08x} {lfs:08x} {:08x}", s.path, s.at.segment, s.bound as u32);
        }
    }

    let bytes = std::fs::read(std::env::args().nth(1).unwrap_or_else(|| "job.fsj".into())).expect("a job file");
    let budget = std::env::args().nth(2).map_or(8, |b| b.parse().expect("a number of turns"));
    let answer = std::thread::Builder::new()
        .stack_size(64 << 20)
        .spawn(move || {
            let (mut medial, mut nodes) = (vec![Default::default(); MEDIAL], vec![Default::default(); MEDIAL_NODES]);
            run(
                bytes.into_iter(),
                budget,
                &mut Arena {
                    cubics: &mut vec![Default::default(); CUBICS],
                    lengths: &mut [(0, false); PATHS],
                    segments: &mut vec![Default::default(); SEGMENTS],
                    paths: &mut vec![Default::default(); PATHS],
                    arcs: &mut vec![Default::default(); ARCS],
                    nodes: &mut vec![Default::default(); ARC_NODES],
                    items: &mut vec![Default::default(); ARCS],
                    order: &mut vec![0; ORDER],
                    contacts: &mut vec![Default::default(); CONTACTS],
                    medial: &mut medial,
                    medial_items: &mut vec![Default::default(); MEDIAL_ITEMS],
                    medial_nodes: &mut nodes,
                },
                &mut Print,
            )
        })
        .expect("a thread")
        .join()
        .expect("no panic");
    match answer {
        Ok(totals) => eprintln!("{totals:?}"),
        Err(fault) => {
            println!("fault {fault:?}");
            std::process::exit(3);
        }
    }
}
