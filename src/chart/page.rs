//! The frame of the report: one page that needs nothing besides itself.

use super::text::escaped;

/// How it looks. No font, script or picture is fetched.
const STYLE: &str = "\
body{font:15px/1.5 Ubuntu,Helvetica,Arial,sans-serif;color:#22262d;background:#fff;max-width:1180px;margin:2em auto;padding:0 1em}\
h1{font-size:1.7em;margin:0 0 .3em}h2{font-size:1.25em;margin:2em 0 .4em;border-bottom:1px solid #d7dbe0;padding-bottom:.2em}\
h3{font-size:1.05em;margin:1.4em 0 .2em}p{max-width:78ch;margin:.4em 0}small{color:#666d78}\
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:13px;margin:.6em 0}\
th,td{padding:3px 9px;text-align:left;vertical-align:top;border-bottom:1px solid #e6e9ed}\
thead th{border-bottom:2px solid #9aa0a8;white-space:nowrap}\
.n{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}.name{white-space:nowrap}\
.best{font-weight:bold;background:#f3f7fb}.none{color:#8b919b}.far{color:#a33d00;font-weight:bold}\
.mark{vertical-align:-2px}.held{color:#00664a;font-weight:bold}.fails{color:#a33d00;font-weight:bold}.open{color:#666d78}\
.unsure{font-style:italic;text-decoration:underline dotted}\
.tag{display:inline-block;border:1px solid currentColor;border-radius:4px;padding:0 .5em;margin:.15em .1em;font-size:13px}\
.warn{border-left:4px solid #d55e00;padding:.2em .8em;background:#fdf3ec}\
figure{margin:0;display:inline-block;vertical-align:top;width:252px;padding:0 8px 12px 0}\
figure img{width:100%;display:block;border:1px solid #d7dbe0;image-rendering:auto}\
figcaption{font-size:12px;line-height:1.35;padding-top:2px}.pair{display:flex;gap:2px}.pair img{width:50%}\
details{margin:.5em 0}summary{cursor:pointer;font-weight:bold}svg.chart{max-width:100%;height:auto}";

/// A page with this title and what lies in it.
pub(super) fn page(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>{STYLE}</style>\n\
</head>\n<body>\n{body}</body>\n</html>\n",
        escaped(title)
    )
}
