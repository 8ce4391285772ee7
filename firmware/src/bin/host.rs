//! The controller on the host: runs the job that is named (`host JOB [PEN [TABLES]]`), prints the samples as the chip does and
//! writes the motors' steps to PEN. A job that brings its lfs along is drawn with it.
//!
//! TABLES.cubics.csv and TABLES.samples.csv are for a judge that knows neither job nor kernel: the job's cubics, and the
//! samples by path, cubic and parameter there.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[cfg(not(target_os = "none"))]
fn main() {
    host::main();
}

#[cfg(not(target_os = "none"))]
mod host {
    use feature_sampling::bezier::Cubic;
    use feature_sampling::geometry::Point;
    use feature_sampling::sampling::Sample;
    use fsample_job::{Command, Decoder};
    use fsample_planner::MotorStep;
    use plotter::own::{self, MedialMemory};
    use plotter::stream::JobMemory;
    use plotter::*;
    use std::fmt::Write;

    #[derive(Default)]
    struct Print {
        pen: Vec<u8>,
        samples: Vec<Sample<f32>>,
    }

    impl Listener for Print {
        fn before(&mut self) {}
        fn after(&mut self, _: Work) {}
        fn sample(&mut self, s: &Sample<f32>) {
            let [t, x, y, lfs] = [s.at.t, s.point.x, s.point.y, s.lfs].map(f32::to_bits);
            println!("s {:08x} {:08x} {t:08x} {x:08x} {y:08x} {lfs:08x} {:08x}", s.path, s.at.segment, s.bound as u32);
            self.samples.push(s.clone());
        }
        fn pen(&mut self, down: bool) {
            self.pen.extend(u32::from(down).to_le_bytes());
        }
        fn motor(&mut self, step: MotorStep) {
            self.pen.extend(step.word().to_le_bytes());
        }
    }

    /// What a job draws, as it came.
    #[derive(Default)]
    struct Job {
        paths: Vec<(bool, Vec<Cubic<f32>>)>,
        with_lfs: bool,
    }

    impl Job {
        /// As far as the stream can be read.
        fn new(bytes: &[u8]) -> Self {
            let (mut decoder, mut job, mut here) = (Decoder::new(), Self::default(), Point::new(0.0, 0.0));
            for command in bytes.iter().map_while(|&byte| decoder.push(byte).ok()).flatten() {
                let cubic = match command {
                    Command::Begin { at: [x, y], closed } => {
                        here = Point::new(x, y);
                        job.paths.push((closed, Vec::new()));
                        continue;
                    }
                    Command::Line([x, y]) => Cubic::line(here, Point::new(x, y)),
                    Command::Cubic([a, b, c, d, e, f]) => {
                        Cubic::new(here, Point::new(a, b), Point::new(c, d), Point::new(e, f))
                    }
                    command => {
                        job.with_lfs |= matches!(command, Command::Table { .. });
                        continue;
                    }
                };
                here = *cubic.end();
                if let Some((_, cubics)) = job.paths.last_mut() {
                    cubics.push(cubic);
                }
            }
            job
        }

        /// The two tables.
        fn tables(&self, samples: &[Sample<f32>]) -> [String; 2] {
            let mut cubics = String::from("path,closed,x0,y0,x1,y1,x2,y2,x3,y3\n");
            for (path, (closed, list)) in (0_u32..).zip(&self.paths) {
                for cubic in list {
                    let points = cubic.points.map(|p| format!("{},{}", p.x, p.y)).join(",");
                    let _ = writeln!(cubics, "{path},{},{points}", u8::from(*closed));
                }
            }
            // The job's cubics are those of C, counted through all paths.
            let along = |(path, (_, cubics)): (u32, &(bool, Vec<Cubic<f32>>))| {
                (0..).zip(cubics).map(|(k, _)| (path, k)).collect::<Vec<(u32, u32)>>()
            };
            let places: Vec<(u32, u32)> = (0..).zip(&self.paths).flat_map(along).collect();
            let mut rows = String::from("path,segment,t,x,y,lfs\n");
            for s in samples {
                let Some((path, segment)) = places.get(s.at.segment as usize) else { continue };
                let _ = writeln!(rows, "{path},{segment},{},{},{},{}", s.at.t, s.point.x, s.point.y, s.lfs);
            }
            [cubics, rows]
        }
    }

    /// A job of tier 2.
    fn own_lfs(bytes: Vec<u8>, print: &mut Print) -> Result<Totals, Fault> {
        let (mut nodes, mut items) = (vec![Default::default(); NODES], vec![Default::default(); LEAVES]);
        let memory = JobMemory {
            segments: &mut vec![Default::default(); CUBICS],
            columns: &mut vec![Default::default(); CUBICS],
            paths: &mut vec![Default::default(); PATHS],
            arcs: &mut vec![Default::default(); ARCS],
            values: &mut [],
        };
        let received = own::receive(bytes.into_iter(), memory, &mut nodes, &mut items, print)?;
        let medial = MedialMemory {
            contacts: &mut vec![Default::default(); CONTACTS],
            values: &mut vec![0; VALUES],
            most: &mut vec![0.0; NODES],
        };
        own::draw(&received, medial, TURNS, print)
    }

    /// A job of tier 1.
    fn given_lfs(bytes: Vec<u8>, print: &mut Print) -> Result<Totals, Fault> {
        let memory = JobMemory {
            segments: &mut vec![Default::default(); CUBICS],
            columns: &mut vec![Default::default(); CUBICS],
            paths: &mut vec![Default::default(); PATHS],
            arcs: &mut [],
            values: &mut vec![0; VALUES],
        };
        table::draw(&table::receive(bytes.into_iter(), memory)?, TURNS, print)
    }

    fn write(name: &str, bytes: &[u8]) {
        if let Err(error) = std::fs::write(name, bytes) {
            eprintln!("{name}: {error}");
            std::process::exit(4)
        }
    }

    pub fn main() {
        let mut arguments = std::env::args().skip(1);
        let (Some(name), pen, tables) = (arguments.next(), arguments.next(), arguments.next()) else {
            eprintln!("usage: host JOB [PEN [TABLES]]");
            std::process::exit(2)
        };
        let bytes = match std::fs::read(&name) {
            Ok(bytes) => bytes,
            Err(error) => {
                eprintln!("{name}: {error}");
                std::process::exit(3)
            }
        };
        let mut print = Print::default();
        let job = Job::new(&bytes);
        let answer = if job.with_lfs { given_lfs(bytes, &mut print) } else { own_lfs(bytes, &mut print) };
        if let Some(name) = pen {
            write(&name, &print.pen);
        }
        if let Some(name) = tables {
            let [cubics, samples] = job.tables(&print.samples);
            write(&format!("{name}.cubics.csv"), cubics.as_bytes());
            write(&format!("{name}.samples.csv"), samples.as_bytes());
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
}
