"""The page's style sheet: on a screen, in the dark, and on paper."""

STYLE = """
:root{--ink:#1b2530;--soft:#5b6875;--line:#dde3e8;--page:#fff;--tint:#f6f8fa;--blue:#2f6fb0;--green:#1d7f5c;--red:#c0312b;
--amber:#b26a00;--violet:#6b5bb5;--held:#f3c469;--heldink:#5a3c00;--exec:#cfd9e2;--execink:#34424f;--skill:#3f7fbf;
--safe:#2a9d8f;--bad:#8d6a9f;--okbg:#e7f4ee;--badbg:#fdecea;--warnbg:#fff4df}
@media (prefers-color-scheme:dark){:root{--ink:#e6ebf0;--soft:#9aa7b4;--line:#303a44;--page:#14191f;--tint:#1b222a;
--blue:#7db4ea;--green:#5fcaa3;--red:#ff8a80;--amber:#f0b355;--violet:#b1a4f0;--held:#8a6a24;--heldink:#ffe6b3;
--exec:#35414d;--execink:#cdd7e0;--skill:#2f6ea8;--safe:#1f7a70;--bad:#6d4f7e;--okbg:#15312680;--badbg:#43201e;
--warnbg:#3a2d14}}
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--ink);font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,
"Noto Sans","DejaVu Sans",sans-serif;overflow-wrap:anywhere}
main{max-width:1080px;margin:0 auto;padding:32px 28px 64px}
h1{font-size:26px;line-height:1.2;margin:2px 0 4px;letter-spacing:-.01em}
h2{font-size:19px;margin:44px 0 12px;padding-top:16px;border-top:2px solid var(--ink)}
h3{font-size:12px;margin:26px 0 8px;text-transform:uppercase;letter-spacing:.07em;color:var(--soft);font-weight:600}
p{margin:6px 0}.soft,.legend,dt,th{color:var(--soft)}.small{font-size:13px}
code,pre,.mono{font-family:ui-monospace,"SF Mono","DejaVu Sans Mono",Menlo,Consolas,monospace;font-size:13px}
pre{white-space:pre-wrap;background:var(--tint);border-left:3px solid var(--line);padding:8px 12px;margin:6px 0}
.over{font-size:12px;letter-spacing:.08em;text-transform:uppercase;color:var(--soft)}
.pill{display:inline-block;padding:1px 10px;border-radius:99px;font-size:13px;font-weight:600;border:1px solid;
white-space:nowrap}
.completed,.allowed,.succeeded{color:var(--green)}.rejected,.halted,.refused,.failed{color:var(--red)}
.cancelled,.unknown,.asked,.open{color:var(--amber)}.pending{color:var(--soft)}
.banner{padding:12px 16px;border-radius:8px;margin:18px 0;border:1px solid var(--line)}
.banner ul{margin:6px 0 0;padding-left:20px}.banner.good{background:var(--okbg);border-color:var(--green)}
.banner.bad{background:var(--badbg);border:3px solid var(--red)}.banner.bad strong{color:var(--red);font-size:18px}
.banner.note{background:var(--warnbg);border-color:var(--amber)}
blockquote.request{margin:10px 0;padding:14px 18px;font-size:20px;line-height:1.6;background:var(--tint);
border-left:4px solid var(--ink);border-radius:0 8px 8px 0;white-space:pre-wrap}
mark{background:none;color:inherit;border-bottom:3px solid;padding-bottom:1px}
.w-action{border-color:var(--blue)}.w-robot{border-color:var(--violet)}.w-value{border-color:var(--green)}
.w-excluded{border-color:var(--red);text-decoration:line-through;text-decoration-color:var(--red)}
.w-unknown,.w-unread{border-bottom:3px dotted var(--amber)}
.read{display:flex;flex-wrap:wrap;gap:6px 18px;font-size:13px;margin:0;padding:0;list-style:none}
table{border-collapse:collapse;width:100%;font-size:14px}
th{text-align:left;font-weight:600;font-size:12px;padding:4px 10px 4px 0;border-bottom:1px solid var(--line);
white-space:nowrap}
td{padding:6px 10px 6px 0;border-bottom:1px solid var(--line);vertical-align:top}
td.n,th.n{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums;padding-right:14px;width:1%}
td.fit{white-space:nowrap;width:1%}td.out{min-width:9.5em}
ul.args{margin:0;padding:0;list-style:none}ul.args li{margin:1px 0}
dl{display:grid;grid-template-columns:max-content 1fr;gap:3px 18px;margin:8px 0;font-size:14px}dd{margin:0}
.why{border:1px solid var(--red);border-left-width:5px;border-radius:8px;padding:12px 16px;margin:14px 0;
background:var(--badbg)}.why.asked{color:var(--ink);border-color:var(--amber);background:var(--warnbg)}
.why>p:first-child{font-size:16px;font-weight:600}
.would{border-top:1px solid var(--line);margin-top:10px;padding-top:8px}
details{border-bottom:1px solid var(--line);padding:5px 0}summary{cursor:pointer}
summary .n{display:inline-block;min-width:28px;color:var(--soft)}summary .t{display:inline-block;min-width:74px;
color:var(--soft);font-variant-numeric:tabular-nums}
details>p,details>pre{margin-left:28px}
details table{margin:6px 0 10px 28px;width:calc(100% - 28px);font-size:13px}details td{padding:2px 12px 2px 0;border:0}
td.group{color:var(--soft);white-space:nowrap;width:1%}
.scroll{overflow-x:auto}.timeline{width:100%;min-width:720px;height:auto;font-size:12px;display:block}
.tick{stroke:var(--line)}.rule{stroke:var(--line)}.axis{fill:var(--soft);font-size:11px}
.lane{fill:var(--ink);font-weight:600;font-size:13px}.bar{stroke:none}.bar.open{opacity:.55}
.label{font-size:12px;fill:#fff}.l-held{fill:var(--heldink)}.l-executing{fill:var(--execink)}
.b-planning,.k-planning{fill:var(--violet);background:var(--violet)}
.b-asking,.k-asking{fill:var(--amber);background:var(--amber)}.b-held,.k-held{fill:var(--held);background:var(--held)}
.b-executing,.k-executing{fill:var(--exec);background:var(--exec)}
.b-skill,.k-skill{fill:var(--skill);background:var(--skill)}.b-safe,.k-safe{fill:var(--safe);background:var(--safe)}
.b-failed,.b-cancelled,.b-unknown,.k-failed{fill:var(--bad);background:var(--bad)}
.m-value{fill:var(--green);stroke:var(--page);stroke-width:1.5}.m-refused{fill:var(--red);stroke:var(--page);stroke-width:1.5}.m-refused-line{stroke:var(--red);stroke-width:2}
.k-refused{background:var(--red)}.k-value{background:var(--green)}.m-seen{fill:#fff}.m-end{stroke:var(--page);stroke-width:2}
.m-completed{fill:var(--green)}.m-rejected,.m-halted{fill:var(--red)}.m-cancelled{fill:var(--amber)}
.legend{font-size:12px;display:flex;flex-wrap:wrap;gap:4px 16px}
.legend i{display:inline-block;width:11px;height:11px;border-radius:3px;margin-right:5px;vertical-align:-1px}
@media print{@page{margin:12mm}:root{--ink:#000;--soft:#444;--line:#ccc;--page:#fff;--tint:#f6f8fa;--blue:#2f6fb0;
--green:#146c4c;--red:#b3261e;--amber:#8a5200;--violet:#5a4ba5;--held:#f3c469;--heldink:#5a3c00;--exec:#cfd9e2;
--execink:#34424f;--skill:#3f7fbf;--safe:#2a9d8f;--bad:#8d6a9f;--okbg:#eef8f3;--badbg:#fdf1f0;--warnbg:#fff8ea}
body{font-size:8.5pt;line-height:1.4}main{max-width:none;padding:0}table,dl,code,pre,.small,.read,
details table{font-size:8pt}
th,h3,.over,.legend{font-size:7.5pt}details{font-size:8.5pt}
h1{font-size:16pt}h2{font-size:12pt;margin-top:20px}h3{margin-top:16px}blockquote.request{font-size:12pt}
.why>p:first-child{font-size:10pt}*{print-color-adjust:exact;-webkit-print-color-adjust:exact}
h2{break-after:avoid}h3{break-after:avoid}.why,tr,.banner,blockquote,svg{break-inside:avoid}
summary{break-after:avoid}
.timeline{min-width:0}details::details-content{content-visibility:visible;block-size:auto}summary{list-style:none}}
"""
