//! The controller on the host: runs the job that is named (`host JOB [PEN]`), prints the samples as the chip does and writes
//! the motors' steps to PEN.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[cfg(not(target_os = "none"))]
fn main() {
    use feature_sampling::sampling::Sample;
    use fsample_planner::MotorStep;
    use plotter::*;

    #[derive(Default)]
    struct Print {
        pen: Vec<u8>,
    }
    impl Listener for Print {
        fn before(&mut self) {}
        fn after(&mut self, _: Work) {}
        fn sample(&mut self, s: &Sample<f32>) {
            let [t, x, y, lfs] = [s.at.t, s.point.x, s.point.y, s.lfs].map(f32::to_bits);
            println!("s {:08x} {:08x} {t:08x} {x:08x} {y:08x} {lfs:08x} {:08x}", s.path, s.at.segment, s.bound as u32);
        }
        fn pen(&mut self, down: bool) {
            self.pen.extend(u32::from(down).to_le_bytes());
        }
        fn motor(&mut self, step: MotorStep) {
            self.pen.extend(step.word().to_le_bytes());
        }
    }

    let mut arguments = std::env::args().skip(1);
    let (Some(job), pen) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: host JOB [PEN]");
        std::process::exit(2)
    };
    let bytes = match std::fs::read(&job) {
        Ok(bytes) => bytes,
        Err(error) => {
            eprintln!("{job}: {error}");
            std::process::exit(3)
        }
    };
    let mut print = Print::default();
    let mut curve = CurveMemory {
        segments: &mut vec![Default::default(); SEGMENTS],
        paths: &mut vec![Default::default(); PATHS],
        arcs: &mut vec![Default::default(); ARCS],
        nodes: &mut vec![Default::default(); NODES],
    };
    let scratch = Scratch {
        cubics: &mut vec![Default::default(); CUBICS],
        lengths: &mut [(0, false); PATHS],
        items: &mut vec![Default::default(); LEAVES],
        order: &mut vec![0; ORDER],
    };
    let answer = receive(bytes.into_iter(), &mut curve, scratch).and_then(|received| {
        let medial = MedialMemory {
            contacts: &mut vec![Default::default(); CONTACTS],
            blocks: &mut vec![Default::default(); BLOCKS],
            boxes: &mut vec![Default::default(); BOXES],
        };
        draw(&received, &curve, medial, TURNS, &mut print)
    });
    if let Some(name) = pen
        && let Err(error) = std::fs::write(&name, &print.pen)
    {
        eprintln!("{name}: {error}");
        std::process::exit(4)
    }
    match answer {
        Ok(totals) => eprintln!("{totals:?}"),
        Err(fault) => {
            println!("f {:08x}", fault.code());
            eprintln!("{fault:?}");
            std::process::exit(3)
        }
    }
}
