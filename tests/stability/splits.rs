//! Seams where the parts of a parallel-split map meet, under each way to choose a part.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::render::Gpu;

use super::bench::{least, most, naive, picture};
use super::table::{Bound, Table};
use crate::stage::{Item, Stage, View, gpu, light};

const SIZE: (u32, u32) = (192, 96);

fn shader(choice: &str, shadow: &str, options: &str) -> Compiled {
    let lamp = "\"direction\": (0.2, -1, 0.3), \"radius\": 24, \"center\": (0, 0, -20)";
    let graph = light("directional_light", lamp, shadow, "", options);
    let splits = format!("options: {{\"splits\": \"4\", \"choice\": \"{choice}\"}}, params:");
    naive(&graph.replacen("params:", &splits, 1))
}

/// The camera looks along -z, so that depth is -z.
fn view() -> View {
    let position = DVec3::new(0.0, 1.6, 0.0);
    View { position, target: position - DVec3::Z, up: DVec3::Y, half_height: 0.45, size: SIZE }
}

/// Bars high over a long ground; and, if asked, posts in front of each other that face the camera.
fn items(posts: bool) -> Vec<Item> {
    let bar = |i: i32| Item::plane([30.0, 0.5], DMat4::from_translation(DVec3::new(0.0, 4.0, -1.3 * f64::from(i))));
    let mut items = vec![Item::plane([120.0, 100.0], DMat4::IDENTITY)];
    items.extend((0..30).map(bar));
    // What fills the picture above the horizon.
    let facing = |x: f64, z: f64, width: f64, height: f64| {
        let up = DMat4::from_rotation_x(std::f64::consts::FRAC_PI_2);
        Item::plane([width, height], DMat4::from_translation(DVec3::new(x, height / 2.0, -z)) * up)
    };
    items.push(facing(0.0, 45.0, 200.0, 60.0));
    if posts {
        for i in 0..60 {
            let z = 1.2 * 1.06_f64.powi(i);
            items.push(facing(z * 0.8 * (f64::from(i) * 2.39).sin(), z, 0.012 * z, 3.0));
        }
    }
    items
}

fn stage(posts: bool) -> Stage {
    Stage::new(items(posts), view())
}

/// How many different numbers the four pixels of each quad have, by pixel.
fn kinds_in_quads(index: &[f64], (width, height): (u32, u32)) -> Vec<usize> {
    let at = |x: u32, y: u32| index[(y * width + x) as usize];
    let kinds = |x: u32, y: u32| {
        let (x, y) = (x & !1, y & !1);
        let mut all = vec![at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        all.sort_by(f64::total_cmp);
        all.dedup();
        all.len()
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| kinds(x, y)).collect()
}

/// Pixels that differ by more than 1/255 from explicit gradients with the same choice: in quads of two splits, in
/// quads of more; and how many pixels there are in quads of two, and of more.
pub(super) fn seams(gpu: &mut Gpu, choice: &str, posts: bool) -> [usize; 4] {
    let stage = stage(posts);
    let index = stage.look(gpu, &shader("pixel", "split_index", ""));
    let kinds = kinds_in_quads(&index, SIZE);
    let explicit = "\"size\": \"512\", \"anisotropy\": \"1\", \"sampling\": \"hardware\"";
    let reference = stage.look(gpu, &shader(choice, "variance_shadow", explicit));
    let implicit = stage.look(gpu, &shader(choice, "implicit_variance", ""));
    picture(&format!("seams_{choice}_{posts}_explicit"), &reference, SIZE);
    picture(&format!("seams_{choice}_{posts}_implicit"), &implicit, SIZE);
    let bad = |least: usize, most: usize| {
        let off = |i: &usize| (implicit[*i] - reference[*i]).abs() > 1.0 / 255.0 && (least..=most).contains(&kinds[*i]);
        (0..implicit.len()).filter(off).count()
    };
    let with = |least: usize, most: usize| kinds.iter().filter(|k| (least..=most).contains(*k)).count();
    [bad(2, 2), bad(3, 4), with(2, 2), with(3, 4)]
}

#[test]
fn one_split_for_a_quad_closes_the_seams_of_implicit_gradients() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "seams",
        "A long ground under bars, four splits of 512: pixels where a sampler that takes gradients from its quad differs by\nmore than 1/255 from explicit gradients of the same splits. One split for each quad cures all quads on which two\nsplits meet. At outlines more may meet, but each triangle shades whole quads by itself.",
        (0.0, ""),
        (2.0, 0.05),
    );
    for posts in [false, true] {
        for choice in ["pixel", "quad"] {
            let [bad, worse, two, more] = seams(&mut gpu, choice, posts);
            let what = format!("{}, {choice}", if posts { "posts" } else { "open ground" });
            assert!(two > 50, "{two} pixels on seams");
            let (law, bound) = if choice == "pixel" {
                ("meaningless gradients", Bound::Least(two as f64 * 0.02))
            } else {
                ("T14: none", Bound::Most(0.0))
            };
            table.row(format!("{what}: of {two} where two meet"), law, bad as f64, bound);
            table.row(
                format!("{what}: of {more} where more meet"),
                "one triangle, one split",
                worse as f64,
                Bound::Most(0.0),
            );
        }
    }
    table.check(&gpu);
}

/// Of all 256 ways in which splits can meet in a quad: where the pixels of a quad disagree after the choice, in how many
/// quads of one or two neighbouring splits they do, and where they agree on a split that none asked for.
pub(super) fn disagreements(gpu: &mut Gpu) -> [usize; 3] {
    let stage = Stage::new(vec![Item::plane([4.0, 4.0], DMat4::IDENTITY)], View::down((0.0, 0.0), 1.0, 1.0, (32, 32)));
    let mut look = |of: &str| {
        let lamp = "\"direction\": (0, -1, 0)";
        let graph = light("directional_light", lamp, "split_index", "", &format!("\"of\": \"{of}\""));
        let values = stage.look(gpu, &naive(&graph));
        let at = |x: u32, y: u32| (values[(y * 32 + x) as usize] * 4.0).round();
        let quad = |q: u32| [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| at(q % 16 * 2 + i, q / 16 * 2 + j));
        (0..256).map(quad).collect::<Vec<[f64; 4]>>()
    };
    let (asked, chosen) = (look("pattern"), look("chosen"));
    let mut counts = [0; 3];
    for (q, (asked, chosen)) in (0_u32..).zip(asked.iter().zip(&chosen)) {
        assert_eq!(*asked, std::array::from_fn(|i| f64::from(q >> (2 * i) & 3)), "quads begin at even pixels");
        let disagree = chosen.iter().any(|c| *c != chosen[0]);
        counts[0] += usize::from(disagree);
        counts[1] += usize::from(disagree && most(asked) - least(asked) <= 1.0);
        counts[2] += usize::from(!disagree && !asked.contains(&chosen[0]));
    }
    counts
}

#[test]
fn quads_choose_one_split_in_all_patterns_but_those_of_three_or_four() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "split_patterns",
        "All 256 ways in which the four pixels of a quad lie in four splits. A triangle shades whole quads by itself, so that\nonly one so steep that it crosses three splits within two pixels can meet those that fail.",
        (0.0, ""),
        (0.0, 0.0),
    );
    let [disagree, simple, foreign] = disagreements(&mut gpu);
    table.row(
        "quads whose pixels disagree",
        "T14: 40, of three or four splits",
        disagree as f64,
        Bound::Near(40.0, 0.0),
    );
    table.row("of them with one or two neighbouring splits", "T14: none", simple as f64, Bound::Most(0.0));
    table.row(
        "quads that agree on a split that no pixel asked for",
        "T14: 78, with jumps of two or three",
        foreign as f64,
        Bound::Near(78.0, 0.0),
    );
    table.check(&gpu);
}
