//! The style of the page and its panels, in light and in dark, and the page's script.

/// Colours by name. The tiers' hues are of Okabe and Ito's set, which stay apart for
/// every common kind of colour blindness.
pub(super) const COLOURS: &str = "\
:root{color-scheme:light dark;--page:#f4f3ee;--paper:#fffefb;--ink:#2b2925;--soft:#6b675e;\
--faint:#d9d6cd;--bad:#fbe3d6;--plain:#d55e00;--fast:#0072b2;--nearest:#00805d;\
--inward:#2f9bd6}
@media(prefers-color-scheme:dark){:root{--page:#101216;--paper:#191c22;--ink:#dddad2;\
--soft:#9a9ca4;--faint:#343943;--bad:#3a2216;--plain:#f0843a;--fast:#5aa9e6;\
--nearest:#2fc29a;--inward:#9fd8ff}}
";

/// Panels; a panel's file contains it, the page has it once for all.
pub(super) const PANELS: &str = "\
svg.panel{font-family:'DejaVu Sans',Verdana,sans-serif;background:var(--paper)}
.panel text{fill:var(--ink)}.panel .soft{fill:var(--soft)}.panel .bold{font-weight:bold}
.panel .grid{stroke:var(--faint);stroke-width:1}.panel .rail{fill:var(--faint);opacity:.45}
.panel .frame{fill:none;stroke:var(--soft);stroke-width:1}
.panel .bound{stroke:var(--soft);stroke-width:1;stroke-dasharray:5 4}
.panel .m{fill:currentColor;stroke:currentColor;stroke-width:1.6;stroke-linejoin:round}
.panel .h{fill:var(--paper);stroke:currentColor;stroke-width:1.6;stroke-linejoin:round}
.panel .tie{stroke:currentColor;stroke-width:.8;opacity:.35}
.plain{color:var(--plain)}.fast{color:var(--fast)}
.nearest{color:var(--nearest)}.inward{color:var(--inward)}.any .plain{color:var(--soft)}
";

/// The page alone.
pub(super) const PAGE: &str = "\
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--ink);font:16px/1.55 system-ui,'DejaVu Sans',sans-serif}
main{max-width:1180px;margin:0 auto;padding:2rem 1.2rem 5rem}
h1{font-size:2.1rem;line-height:1.2;margin:.2em 0 .3em}h2{margin:2.6em 0 .5em;font-size:1.45rem}
h3{margin:1.6em 0 .4em;font-size:1.1rem}p,li{max-width:46rem}a{color:var(--fast)}
code,pre{font:13px/1.45 'DejaVu Sans Mono',ui-monospace,monospace}
pre{background:var(--paper);border:1px solid var(--faint);border-radius:6px;padding:.7em .9em;\
overflow-x:auto;white-space:pre-wrap;overflow-wrap:anywhere}
.lead{font-size:1.15rem}.answer li{font-size:1.1rem;margin:.35em 0}td .soft{font-weight:400}.soft{color:var(--soft)}
.panels{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,500px),1fr));gap:1rem}
figure{margin:0;background:var(--paper);border:1px solid var(--faint);border-radius:8px;padding:.6rem;\
min-width:0}
.cases{display:grid;gap:1rem}.case{display:grid;grid-template-columns:minmax(0,1fr) 19rem;gap:.4rem 1rem}
@media(max-width:900px){.case{grid-template-columns:minmax(0,1fr)}}
figure:target{outline:3px solid var(--fast)}
figcaption{padding:.2rem .4rem .4rem;font-size:.92rem}figcaption code{overflow-wrap:anywhere}
figure svg,figure img{width:100%;height:auto;display:block}
.key{display:flex;flex-wrap:wrap;gap:.3rem 1.2rem;margin:.8rem 0;font-size:.95rem}
.key span{display:inline-flex;align-items:center;gap:.4rem}.key svg{width:18px;height:18px}
.wide svg{min-width:860px}.scroll{overflow-x:auto;background:var(--paper);border:1px solid var(--faint);border-radius:8px}
table{border-collapse:collapse;font-size:.86rem;font-variant-numeric:tabular-nums;width:100%}
th,td{padding:.25em .45em;text-align:right;white-space:nowrap;border-bottom:1px solid var(--faint)}
th{cursor:default;color:var(--soft);font-weight:600}th.sortable{cursor:pointer}
td.t,th.t{text-align:left}td.w{white-space:normal;min-width:11rem}
td.bad{background:var(--bad)}td.own{font-weight:600}th.group{text-align:center}details{margin:.4rem 0}summary{cursor:pointer;padding:.2rem 0}
nav{font-size:.95rem}nav a{margin-right:1rem}
@media print{.panels{grid-template-columns:1fr 1fr}figure{break-inside:avoid}}
";

/// Sorts a table by a column when its heading is clicked, numbers as numbers; the page
/// is whole without it.
pub(super) const SCRIPT: &str = r#"
"use strict";
for (const table of document.querySelectorAll("table.sort")) {
  table.tHead.rows[0].querySelectorAll("th").forEach((head, column) => {
    head.classList.add("sortable");
    head.title = "sort";
    head.addEventListener("click", () => {
      const down = head.dataset.down !== "1";
      for (const h of table.tHead.rows[0].cells) delete h.dataset.down;
      head.dataset.down = down ? "1" : "0";
      const body = table.tBodies[0];
      const key = (row) => row.cells[column].dataset.v ?? row.cells[column].textContent;
      const order = (a, b) => {
        const [x, y] = [key(a), key(b)];
        const [n, m] = [parseFloat(x), parseFloat(y)];
        if (isNaN(n) || isNaN(m)) return isNaN(n) - isNaN(m) || x.localeCompare(y);
        return n - m;
      };
      const rows = [...body.rows].sort((a, b) => (down ? order(b, a) : order(a, b)));
      body.append(...rows);
    });
  });
}
"#;
