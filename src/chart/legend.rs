//! What the marks of a chart mean, and where its numbers come from.

use std::fmt::Write as _;

use super::data::Chart;
use super::marks::{color, mark, pale, radius};
use super::text::{cut, escaped, width, wrapped};
use crate::study::Machine;

const SIZE: f64 = 10.5;
const ROW: f64 = 18.0;
const INK: &str = "#22262d";

/// The legend, at most so wide, and its height.
pub(super) fn legend(chart: &Chart<'_>, most: f64) -> (String, f64) {
    let shown = |m: &usize| chart.panels.iter().flat_map(|p| &p.points).any(|p| p.method == *m);
    let methods: Vec<usize> = (0..chart.methods.len()).filter(shown).collect();
    let names: Vec<String> = methods.iter().map(|m| cut(&chart.methods[*m], 40)).collect();
    let widest = names.iter().map(|n| width(n, SIZE)).fold(60.0, f64::max) + 34.0;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and positive")]
    let columns = ((most / widest).floor() as usize).clamp(1, methods.len().max(1));
    let rows = methods.len().div_ceil(columns);
    let mut out = String::new();
    for (i, (method, name)) in methods.iter().zip(&names).enumerate() {
        let (x, y) = ((i / rows) as f64 * widest, (i % rows) as f64 * ROW + 9.0);
        let style = format!("fill=\"{}\" stroke=\"#111111\" stroke-width=\"1\"", color(*method));
        let _ = writeln!(
            out,
            "<path d=\"M{x:.1} {y:.1}h22\" stroke=\"{}\" stroke-width=\"1.1\" stroke-opacity=\"0.5\"/>{}{}",
            color(*method),
            mark(*method, [x + 11.0, y], 5.0, &style),
            words(x + 28.0, y, name)
        );
    }
    let mut y = rows as f64 * ROW + 16.0;
    let mut x = 0.0;
    // Each piece with its width; what does not fit goes into another row.
    let front = "no method here is both quicker and nearer to the truth";
    let first = methods.first().copied().unwrap_or(0);
    let best =
        mark(first, [11.0, 0.0], 5.0, &format!("fill=\"{}\" stroke=\"#111111\" stroke-width=\"1.1\"", color(first)));
    let beaten =
        mark(first, [11.0, 0.0], 5.0, &format!("fill=\"{}\" stroke=\"#9aa0a8\" stroke-width=\"0.8\"", pale(first)));
    let line = format!("<path d=\"M0 0h22\" stroke=\"{INK}\" stroke-width=\"1.7\"/>{best}");
    let mut pieces = vec![(line, front.to_owned(), 28.0), (beaten, "beaten by another".to_owned(), 28.0)];
    // The sizes belong together, so they are one piece.
    let mut sizes = String::new();
    let mut at = 11.0;
    for bits in [16, 32, 64, 128] {
        let r = radius(Some(bits));
        let _ = write!(
            sizes,
            "<circle cx=\"{at:.1}\" cy=\"0\" r=\"{r:.2}\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"0.9\"/>"
        );
        if bits < 128 {
            sizes.push_str(&words(at + r + 5.0, 0.0, &bits.to_string()));
            at += r + 34.0;
        }
    }
    let last = at + radius(Some(128)) + 5.0;
    pieces.push((sizes, "128 bits a texel of the map".to_owned(), last));
    for (shape, text, indent) in pieces {
        let wide = indent + width(&text, SIZE);
        if x > 0.0 && x + wide > most {
            (x, y) = (0.0, y + ROW);
        }
        let _ = writeln!(out, "<g transform=\"translate({x:.1} {y:.1})\">{shape}{}</g>", words(indent, 0.0, &text));
        x += wide + 18.0;
    }
    (out, y + 12.0)
}

fn words(x: f64, y: f64, text: &str) -> String {
    format!("<text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"{SIZE}\" fill=\"{INK}\">{}</text>", y + 3.6, escaped(text))
}

/// Where a machine computes, in words.
pub(super) fn machine(machine: &Machine) -> String {
    let known: Vec<&str> =
        [machine.driver.as_str(), machine.backend.as_str()].into_iter().filter(|t| !t.is_empty()).collect();
    let name = if machine.adapter.is_empty() { "an adapter without a name" } else { &machine.adapter };
    let software = if machine.software {
        ". A software adapter: it computes on the CPU, and its times say nothing about graphics cards"
    } else {
        ""
    };
    let inside = if known.is_empty() { String::new() } else { format!(" ({})", known.join(", ")) };
    format!("{name}{inside}{software}")
}

/// Where the numbers of a chart come from, in words.
pub(super) fn source(chart: &Chart<'_>) -> String {
    let rounds = match chart.rounds {
        (least, most) if least == most => format!("{least} rounds"),
        (least, most) => format!("{least} to {most} rounds"),
    };
    let truth = match chart.reference.as_str() {
        "rays" => "rays, traced in 64 bits",
        "pcf" => "exhaustive filtering with each method's own kernel, in 64 bits",
        other => other,
    };
    let others = match chart.other_frames.len() {
        0 => String::new(),
        _ => {
            let sizes: Vec<String> = chart.other_frames.iter().take(6).map(|f| format!("{} x {}", f.0, f.1)).collect();
            format!(" (also measured: {})", sizes.join(", "))
        }
    };
    format!(
        "Measured on {}. Frames of {} x {}{others}; medians of {rounds}, lines to the sides show the median deviation \
where it can be seen. Truth: {truth}.",
        machine(&chart.machine),
        chart.frame.0,
        chart.frame.1,
    )
}

/// Lines of small print, at most so wide, and their height.
pub(super) fn small_print(text: &str, most: f64) -> (String, f64) {
    let lines = wrapped(text, SIZE, most);
    let mut out = String::new();
    for (i, line) in lines.iter().enumerate() {
        let _ = writeln!(
            out,
            "<text x=\"0\" y=\"{:.1}\" font-size=\"{SIZE}\" fill=\"#50565f\">{}</text>",
            i as f64 * 14.0 + 10.0,
            escaped(line)
        );
    }
    (out, lines.len() as f64 * 14.0)
}
