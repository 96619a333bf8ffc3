//! label: Time
//! category: geometry
//! synonyms: seconds, animation, clock, frame, speed, animate
//! inline
//! Seconds since the start, times a speed: link it where something shall move.

/// seconds (scalar; = @time; hidden; in s): The clock.
/// speed (scalar; = 1): Factor on the clock: 2 is twice as fast, 0 stands still, negative runs backwards.
/// -> time (scalar): Seconds times speed.
fn time(seconds: f32, speed: f32) -> f32 {
    return seconds * speed;
}
