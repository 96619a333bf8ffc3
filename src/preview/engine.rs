//! The threads: one compiles, one renders, one measures while there is something to measure.

use std::collections::{BTreeMap, VecDeque};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::compiler::Compiler;
use super::messages::{Answer, Look, Request};
use super::renderer::{Renderer, Work, points};
use crate::render::AdapterOptions;
use crate::studio::{Failure, FailureKind, figure};

/// Called when an answer is ready, from any thread.
type Wake = Arc<dyn Fn() + Send + Sync>;

/// Makes shaders and pictures in the background. Dropping it ends its threads; it waits a while for those that are about
/// to end, and for none that was left behind.
pub struct Engine {
    shared: Arc<Shared>,
}

struct Shared {
    options: AdapterOptions,
    wake: Wake,
    state: Mutex<State>,
    /// Something is to be compiled.
    to_compile: Condvar,
    /// Something is to be rendered.
    to_render: Condvar,
    /// A thread has ended.
    gone: Condvar,
}

#[derive(Default)]
struct State {
    ended: bool,
    /// Threads that have not ended.
    running: usize,
    /// Threads of these that were left behind.
    left_behind: usize,
    request: Option<Request>,
    thumbnails: VecDeque<Request>,
    picture: Option<Work>,
    small: VecDeque<Work>,
    /// What stops the truth that is being computed for the current picture.
    cancel: Option<Arc<AtomicBool>>,
    /// When the device began with the current picture.
    drawing: Option<Instant>,
    /// Which render thread counts; those before it were left behind.
    renderer: u64,
    measuring: Option<Arc<AtomicBool>>,
    answers: Vec<Answer>,
    /// A device that is to be lost before the next picture.
    #[cfg(test)]
    lose: bool,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn answer(&self, answer: Answer) {
        let mut state = self.state();
        if !state.ended {
            state.answers.push(answer);
            drop(state);
            (self.wake)();
        }
    }

    fn failed(&self, revision: u64, failure: Failure) {
        let first = failure.diagnostics.into_iter().next();
        let (message, help) = match first {
            Some(diagnostic) => (diagnostic.message, diagnostic.help),
            None => ("there is no picture, for reasons that were told before".to_owned(), None),
        };
        self.answer(Answer::Failed { revision, message, help });
    }
}

impl Engine {
    /// Starts the threads. The adapter is opened when the first picture is asked for.
    pub fn start(adapter: AdapterOptions, wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        let shared = Arc::new(Shared {
            options: adapter,
            wake,
            state: Mutex::new(State::default()),
            to_compile: Condvar::new(),
            to_render: Condvar::new(),
            gone: Condvar::new(),
        });
        let engine = Self { shared };
        engine.spawn("compile", compile);
        engine.spawn("render", |shared| render(shared, 0));
        engine
    }

    fn spawn(&self, name: &str, work: impl FnOnce(&Arc<Shared>) + Send + 'static) {
        self.shared.state().running += 1;
        let running = Running(self.shared.clone());
        // Where no thread can be started, the count goes down as what it was to do is dropped.
        if let Err(error) = thread::Builder::new().name(name.into()).spawn(move || work(&running.0)) {
            let message = format!("no thread could be started: {error}");
            self.shared.answer(Answer::Failed { revision: 0, message, help: None });
        }
    }

    /// Asks for shaders and a picture. A request that was not begun is replaced.
    pub fn ask(&self, request: Request) {
        self.shared.state().request = Some(request);
        self.shared.to_compile.notify_one();
    }

    /// Asks for a small picture of a node, for when there is nothing else to do. It takes the place of one of the same
    /// node that was not begun.
    pub fn thumbnail(&self, request: Request) {
        let mut state = self.shared.state();
        match state.thumbnails.iter_mut().find(|t| t.look == request.look) {
            Some(known) => *known = request,
            None => state.thumbnails.push_back(request),
        }
        drop(state);
        self.shared.to_compile.notify_one();
    }

    /// What became of requests since it was last asked.
    pub fn answers(&self) -> Vec<Answer> {
        std::mem::take(&mut self.shared.state().answers)
    }

    /// How long the device has been working on the current picture.
    pub fn busy(&self) -> Option<Duration> {
        self.shared.state().drawing.map(|begun| begun.elapsed())
    }

    /// Leaves a render thread behind that does not come back, and what it was doing; a new one opens a new device.
    pub fn abandon(&mut self) {
        let mut state = self.shared.state();
        state.renderer += 1;
        state.left_behind += 1;
        state.drawing = None;
        state.picture = None;
        state.small.clear();
        if let Some(cancel) = state.cancel.take() {
            cancel.store(true, Ordering::Relaxed);
        }
        let number = state.renderer;
        drop(state);
        self.spawn("render", move |shared| render(shared, number));
    }

    /// Measures every kind of shadow on a light, one after the other, in place of what was measured before.
    pub fn measure(&self, request: Request, light: String) {
        let cancel = Arc::new(AtomicBool::new(false));
        if let Some(before) = self.shared.state().measuring.replace(cancel.clone()) {
            before.store(true, Ordering::Relaxed);
        }
        self.spawn("measure", move |shared| {
            let (catalog, _, _) = Compiler::default().catalog(&request.nodes);
            let each = |point| {
                if !cancel.load(Ordering::Relaxed) {
                    shared.answer(Answer::Point(point));
                }
            };
            let work = || points(&shared.options, &request, &light, &catalog, &cancel, each);
            match guarded(work) {
                Err(failure) if failure.kind != FailureKind::Cancelled => shared.failed(request.revision, failure),
                _ => {}
            }
            // What was called off in favour of another measurement is not its end.
            let current = |known: &Arc<AtomicBool>| Arc::ptr_eq(known, &cancel);
            let mut state = shared.state();
            if state.measuring.as_ref().is_some_and(current) {
                state.measuring = None;
                drop(state);
                shared.answer(Answer::Measured);
            }
        });
    }

    /// Calls a measurement off.
    pub fn cancel(&self) {
        if let Some(cancel) = &self.shared.state().measuring {
            cancel.store(true, Ordering::Relaxed);
        }
    }

    /// Draws a figure and writes it. Texts stand in place of files, and folders hold further nodes, as in a request.
    pub fn figure(
        &self,
        wanted: figure::Request,
        overlay: BTreeMap<PathBuf, Arc<str>>,
        nodes: Vec<PathBuf>,
        path: PathBuf,
    ) {
        self.spawn("figure", move |shared| {
            let work = || super::renderer::figure(&shared.options, &wanted, overlay, &nodes, &path);
            let failure = guarded(work).err().map(|failure| {
                let first = failure.diagnostics.into_iter().next();
                first.map_or_else(|| "its graphs are broken".to_owned(), |d| d.message)
            });
            shared.answer(Answer::Figure { path, failure });
        });
    }

    /// Loses the device before the next picture.
    #[cfg(test)]
    pub(super) fn lose(&self) {
        self.shared.state().lose = true;
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        let mut state = self.shared.state();
        state.ended = true;
        for cancel in [&state.cancel, &state.measuring].into_iter().flatten() {
            cancel.store(true, Ordering::Relaxed);
        }
        drop(state);
        self.shared.to_compile.notify_all();
        self.shared.to_render.notify_all();
        // A driver that is unloaded under a thread that uses it takes the program with it.
        let busy = |state: &mut State| state.running > state.left_behind;
        let _ = self.shared.gone.wait_timeout_while(self.shared.state(), PATIENCE, busy);
    }
}

/// How long threads have to end.
const PATIENCE: Duration = Duration::from_secs(10);

/// Counts a thread for as long as it runs.
struct Running(Arc<Shared>);

impl Drop for Running {
    fn drop(&mut self) {
        let mut state = self.0.state();
        state.running = state.running.saturating_sub(1);
        drop(state);
        self.0.gone.notify_all();
    }
}

/// A panic is a fault of the program, but no reason to lose what a person is editing.
fn guarded<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        let message = "the program has a fault: it stopped unexpectedly here";
        Err(vec![crate::diagnostic::Diagnostic::error("ST0514", message, crate::diagnostic::Place::default())].into())
    })
}

fn compile(shared: &Arc<Shared>) {
    let mut compiler = Compiler::default();
    let mut told: Option<Request> = None;
    loop {
        let mut state = shared.state();
        let (request, small) = loop {
            if state.ended {
                return;
            }
            if let Some(request) = state.request.take() {
                break (request, false);
            }
            if let Some(request) = state.thumbnails.pop_front() {
                break (request, true);
            }
            state = shared.to_compile.wait(state).unwrap_or_else(PoisonError::into_inner);
        };
        drop(state);
        let outcome = match guarded(|| Ok(compiler.compile(&request))) {
            Ok(outcome) => outcome,
            Err(failure) => {
                compiler = Compiler::default();
                shared.failed(request.revision, failure);
                continue;
            }
        };
        let work = |shot| {
            let (catalog, cancel) = (outcome.catalog.clone(), Arc::default());
            Work { request: request.clone(), shot, catalog, cancel }
        };
        if small {
            if let Some(shot) = outcome.shot.clone() {
                let mut state = shared.state();
                state.small.retain(|w| w.request.look != request.look);
                state.small.push_back(work(shot));
                drop(state);
                shared.to_render.notify_one();
            }
            continue;
        }
        let before = told.replace(request.clone());
        let view = |r: &Request| (r.camera, r.size, r.samples, r.time.to_bits());
        let moved = before.as_ref().is_none_or(|b| view(b) != view(&request));
        if outcome.milliseconds > 0.0 || before.is_none_or(|b| b.revision != request.revision) {
            shared.answer(Answer::Shaders(outcome.shaders(request.revision)));
        }
        let good = compiler.good(&request, &outcome).filter(|(_, own)| *own || moved);
        if let Some((shot, _)) = good {
            let mut state = shared.state();
            if let Some(cancel) = &state.cancel {
                cancel.store(true, Ordering::Relaxed);
            }
            state.picture = Some(work(shot));
            drop(state);
            shared.to_render.notify_one();
        }
    }
}

fn render(shared: &Arc<Shared>, number: u64) {
    let mut renderer = Renderer::new(shared.options.clone());
    loop {
        let mut state = shared.state();
        let (work, small) = loop {
            if state.renderer != number {
                state.left_behind = state.left_behind.saturating_sub(1);
                return;
            }
            if state.ended {
                return;
            }
            if let Some(work) = state.picture.take() {
                break (work, false);
            }
            if let Some(work) = state.small.pop_front() {
                break (work, true);
            }
            state = shared.to_render.wait(state).unwrap_or_else(PoisonError::into_inner);
        };
        state.cancel = Some(work.cancel.clone()).filter(|_| !small);
        #[cfg(test)]
        if std::mem::take(&mut state.lose) {
            renderer.lose();
        }
        drop(state);
        let drawing = |begun: bool| {
            let mut state = shared.state();
            if state.renderer == number {
                state.drawing = begun.then(Instant::now);
            }
        };
        let result = guarded(|| renderer.picture(&work, &drawing));
        let mut state = shared.state();
        if state.renderer != number {
            // It came back after all.
            state.left_behind = state.left_behind.saturating_sub(1);
            return;
        }
        state.drawing = None;
        state.cancel = None;
        drop(state);
        match (result, small) {
            (Ok(image), false) => shared.answer(Answer::Image(image)),
            (Ok(image), true) => {
                let Look::Node { node, .. } = work.request.look else { continue };
                shared.answer(Answer::Thumbnail { node, image });
            }
            // A small picture that cannot be made is told of where the node is seen at its full size.
            (Err(_), true) => {}
            // What was called off is followed by what took its place.
            (Err(failure), false) if failure.kind == FailureKind::Cancelled => {}
            (Err(failure), false) => shared.failed(work.request.revision, failure),
        }
    }
}
