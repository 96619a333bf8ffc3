//! Claims about costs: C4, C9 to C11 and C22.

use shadetree::render::Gpu;

use super::{Claim, timed};
use crate::stability::table::Bound;
use crate::stability::timing::{Timed, Times, times};

const PLAIN: Timed = Timed { shadow: "hard_shadow", options: "", size: 512, width: 256, segments: 24 };
const PCF: Timed = Timed { shadow: "pcf_shadow", options: ", \"width\": \"5\"", ..PLAIN };
const VSM: Timed = Timed { shadow: "variance_shadow", options: ", \"width\": \"5\"", ..PLAIN };
const TABLE: Timed = Timed { shadow: "summed_area_shadow", options: ", \"footprint\": \"fixed\"", size: 256, ..PLAIN };

pub(super) fn claims(gpu: &mut Gpu) -> Vec<Claim> {
    let unfiltered = Timed { options: ", \"width\": \"1\"", ..VSM };
    let all = [
        PLAIN,
        unfiltered,
        Timed { segments: 200, ..VSM },
        VSM,
        Timed { size: 256, ..PCF },
        Timed { size: 1024, ..PCF },
        Timed { size: 256, width: 512, ..PCF },
        Timed { size: 1024, ..VSM },
        Timed { width: 512, ..VSM },
        Timed { width: 512, ..PLAIN },
        TABLE,
        Timed { size: 1024, ..TABLE },
    ];
    let found = times(gpu, &all).expect("lavapipe has a clock");
    let [
        plain,
        unfiltered,
        complex,
        vsm,
        pcf,
        pcf_large,
        pcf_wide,
        vsm_large,
        vsm_wide,
        plain_wide,
        table,
        table_large,
    ] = found[..]
    else {
        unreachable!()
    };
    let ratio = |a: Times, b: Times, of: fn(Times) -> f64| of(a) / of(b);
    vec![
        Claim {
            id: 4,
            source: "VSM",
            says: "A variance map costs about what a plain map does",
            holds: vec![timed(
                "frame time over that of a plain map of 512 texels is at most 1.6",
                ratio(unfiltered, plain, |t| t.all),
                Bound::Most(1.6),
            )],
            limits: vec![],
        },
        Claim {
            id: 9,
            source: "VSM",
            says: "The cost does not depend on how complex the geometry is",
            holds: vec![timed(
                "blur with 40,000 triangles over that with 600 is at most 1.3",
                ratio(complex, vsm, |t| t.blur),
                Bound::Most(1.3),
            )],
            limits: vec![timed(
                "drawing the casters takes at least 2 times as long",
                ratio(complex, vsm, |t| t.casters),
                Bound::Least(2.0),
            )],
        },
        Claim {
            id: 10,
            source: "VSM",
            says: "The cost of percentage-closer filtering follows the pixels, not the map",
            holds: vec![
                timed(
                    "shading with sixteen times the texels takes at most 1.5 times as long",
                    ratio(pcf_large, pcf, |t| t.main),
                    Bound::Most(1.5),
                ),
                timed(
                    "shading four times the pixels takes at least 2.5 times as long",
                    ratio(pcf_wide, pcf, |t| t.main),
                    Bound::Least(2.5),
                ),
            ],
            limits: vec![],
        },
        Claim {
            id: 11,
            source: "VSM",
            says: "Variance maps grow with the frame like plain maps; blurs with the map",
            holds: vec![
                timed(
                    "shading four times the pixels, growth over that of a plain map is within 1 +- 0.4",
                    ratio(vsm_wide, vsm, |t| t.main) / ratio(plain_wide, plain, |t| t.main),
                    Bound::Near(1.0, 0.4),
                ),
                timed(
                    "blurring 1024 texels takes at least 2.5 times as long as 512",
                    ratio(vsm_large, vsm, |t| t.blur),
                    Bound::Least(2.5),
                ),
                timed(
                    "blur with four times the pixels over that with one is at most 1.3",
                    ratio(vsm_wide, vsm, |t| t.blur),
                    Bound::Most(1.3),
                ),
            ],
            limits: vec![],
        },
        summed(gpu, table, table_large),
    ]
}

/// The width of boxes is a value: it changes no text, so only time could tell.
fn summed(gpu: &mut Gpu, table: Times, large: Times) -> Claim {
    let (narrow, wide) = crate::stability::timing::widths(gpu, 3.0, 33.0).expect("lavapipe has a clock");
    let build = |t: Times| t.all - t.main;
    Claim {
        id: 22,
        source: "note",
        says: "Filtering with a table of sums takes a time that does not depend on the kernel",
        holds: vec![timed(
            "shading with boxes of 33 texels over that with 3 is at most 1.25",
            wide / narrow,
            Bound::Most(1.25),
        )],
        limits: vec![timed(
            "making the table of 1024 takes at least 8 times as long as that of 256",
            build(large) / build(table),
            Bound::Least(8.0),
        )],
    }
}
