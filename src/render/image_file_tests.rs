//! Tests of picture files.

use exr::prelude::traits::*;

use super::*;

fn gradient() -> Vec<[f32; 4]> {
    (0..12_u8).map(|i| [f32::from(i) * 0.37 - 1.0, 1e-7, 1234.5, f32::from(i) / 11.0]).collect()
}

fn notes() -> Vec<(String, String)> {
    vec![("adapter".into(), "Würfel".into()), ("seed".into(), "7".into())]
}

#[test]
fn exr_files_keep_every_bit() {
    let pixels = gradient();
    let file = encode_exr((4, 3), &pixels, &notes()).expect("encodes");
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size: exr::math::Vec2<usize>, _: &exr::image::RgbaChannels| (size.0, vec![[0.0; 4]; size.area()]),
            |(width, to), at, (r, g, b, a): (f32, f32, f32, f32)| to[at.1 * *width + at.0] = [r, g, b, a],
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(&file))
        .expect("decodes");
    assert_eq!(read.layer_data.channel_data.pixels.1, pixels);
    let comment = read.layer_data.attributes.comments.expect("a comment").to_string();
    assert_eq!(comment, "adapter: W?rfel\nseed: 7\n");
}

#[test]
fn png_files_hold_what_the_display_gets() {
    let pixels = vec![[0.5, 0.0, 2.0, 1.0], [0.25, f32::NAN, -1.0, 0.5]];
    let file = encode_png((2, 1), &pixels, &Display::default(), &notes()).expect("encodes");
    let read = image::load_from_memory(&file).expect("decodes, checksums and all").to_rgba8();
    // Half covered pixels are stored undivided: 0.25 at half coverage is the 0.5 of the first pixel.
    assert_eq!(read.get_pixel(0, 0).0, [188, 0, 255, 255]);
    assert_eq!(read.get_pixel(1, 0).0, [188, 0, 0, 128]);
    let text = String::from_utf8_lossy(&file);
    assert!(text.contains("adapter\0\0\0\0\0Würfel"));
}

#[test]
fn checksums_are_those_of_png() {
    // The IEND chunk of every PNG file.
    let mut chunk = Vec::new();
    push_chunk(&mut chunk, *b"IEND", &[]);
    assert_eq!(chunk, [0, 0, 0, 0, b'I', b'E', b'N', b'D', 0xae, 0x42, 0x60, 0x82]);
}

#[test]
fn the_same_picture_gives_the_same_bytes() {
    let exr = || encode_exr((4, 3), &gradient(), &notes()).expect("encodes");
    let png = || encode_png((4, 3), &gradient(), &Display::default(), &notes()).expect("encodes");
    assert_eq!(exr(), exr());
    assert_eq!(png(), png());
}

#[test]
fn exposure_and_tone_act_before_encoding() {
    let brighter = Display { exposure: 1.0, tone: ToneCurve::None };
    assert_eq!(brighter.apply([0.25, 0.5, 0.0, 1.0]), Display::default().apply([0.5, 1.0, 0.0, 1.0]));
    let filmic = Display { exposure: 0.0, tone: ToneCurve::Filmic };
    let [one, two, infinite, _] = filmic.apply([1.0, 2.0, f32::INFINITY, 1.0]);
    assert!(one < two && two < infinite && infinite == 255, "{one} {two} {infinite}");
}

#[test]
fn files_are_replaced_whole_and_pictures_that_are_none_leave_them_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.png");
    write_whole(&path, b"old").expect("writes");
    assert!(write_png(&path, (5, 5), &gradient(), &Display::default(), &[]).is_err());
    assert_eq!(std::fs::read(&path).expect("reads"), b"old");
    write_exr(&path, (4, 3), &gradient(), &[]).expect("writes");
    assert_eq!(std::fs::read(&path).expect("reads")[..4], [0x76, 0x2f, 0x31, 0x01]);
    assert_eq!(std::fs::read_dir(folder.path()).expect("lists").count(), 1, "nothing else is left behind");
    assert!(write_whole(&folder.path().join("none/picture.png"), b"x").is_err());
}
