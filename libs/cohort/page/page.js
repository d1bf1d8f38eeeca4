"use strict";
// The data are scripts beside this page, since a page that is opened from the disk may load nothing else: each calls a function of Cohort.
const Cohort = (() => {
  const byId = id => document.getElementById(id);
  const element = (tag, className, text) => {
    const made = document.createElement(tag);
    if (className) made.className = className;
    if (text !== undefined) made.textContent = text;
    return made;
  };
  const served = location.protocol.startsWith("http");

  // ---- data -------------------------------------------------------------------------------------------------------
  let summary = null, width = 0;
  const indices = [], blocks = new Map(), wanted = new Set();
  const stored = new Map(), pending = new Map();  // row -> review
  const most_blocks = 60, most_at_once = 4;

  function load(name) {
    return new Promise((done, failed) => {
      const script = element("script");
      script.src = "data/" + name + ".js";
      script.onload = () => { script.remove(); done(); };
      script.onerror = () => { script.remove(); failed(new Error(script.src)); };
      document.head.append(script);
    });
  }

  /** A scan's row, or null while its block is on its way. */
  function row_of(scan) {
    const number = Math.floor(scan / summary.rows_of_a_block);
    const block = blocks.get(number);
    if (block) return block[scan - number * summary.rows_of_a_block];
    if (!wanted.has(number) && wanted.size < most_at_once) {
      wanted.add(number);
      load("rows-" + number).catch(() => tell("data/rows-" + number + ".js cannot be read")).finally(() => { wanted.delete(number); changed(); });
    }
    return null;
  }
  function keep_rows(number, rows) {
    blocks.set(number, rows);
    if (blocks.size > most_blocks) blocks.delete(blocks.keys().next().value);
  }
  const digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_";
  const value_of_digit = new Int8Array(128);
  [...digits].forEach((digit, value) => { value_of_digit[digit.charCodeAt(0)] = value; });
  function index_at(scan, offset) {
    const number = Math.floor(scan / summary.scans_of_an_index);
    return value_of_digit[indices[number].charCodeAt((scan - number * summary.scans_of_an_index) * width + offset)];
  }
  const state_of = (scan, stage) => index_at(scan, stage);
  const set_of = scan => 64 * index_at(scan, summary.stages.length) + index_at(scan, summary.stages.length + 1);
  const bin_of = (scan, measure) => index_at(scan, summary.stages.length + 2 + measure);
  const review_of = scan => {
    const one = pending.has(scan) ? pending.get(scan) : stored.get(scan);
    return one && one.verdict !== "none" ? one : null;
  };

  // ---- filters ----------------------------------------------------------------------------------------------------
  const filter = { stage: null, state: null, reason: null, review: null, bins: new Map(), search: "" };
  let shown = null;  // rows that pass; null: all
  const count = () => shown ? shown.length : summary.scans;
  const scan_at = place => shown ? shown[place] : place;

  function tests() {
    const all = [];
    const { stage, state, reason, review, bins, search } = filter;
    if (stage !== null) all.push(scan => state_of(scan, stage) === state);
    if (reason !== null) {
      const holds = new Set(summary.sets.filter(([, reasons]) => reasons.includes(reason)).map(([number]) => number));
      all.push(scan => holds.has(set_of(scan)));
    }
    if (review === "open") all.push(scan => !review_of(scan));
    else if (review !== null) all.push(scan => { const one = review_of(scan); return one !== null && one.verdict === review; });
    for (const [measure, bin] of bins) all.push(scan => bin_of(scan, measure) === bin);
    if (search) {
      const from = summary.stages.length + 2 + summary.measures.length, codes = [...search].map(c => value_of_digit[c.charCodeAt(0)]);
      all.push(scan => codes.every((code, i) => index_at(scan, from + i) === code));
    }
    return all;
  }
  function apply_filter() {
    const all = tests();
    if (all.length === 0) shown = null;
    else {
      const found = [];
      for (let scan = 0; scan < summary.scans; ++scan)
        if (all.every(test => test(scan))) found.push(scan);
      shown = Uint32Array.from(found);
    }
    chosen = 0;
    position = 0;
    lay_out();
    show_side();
  }

  // ---- the list and the wall --------------------------------------------------------------------------------------
  // A browser cannot make an element as high as a million rows: above `most_height` the scroll bar is a scale of the true position.
  const most_height = 8e6, row_height = 28, tile_width = 198, tile_height = 178;
  const scroller = byId("scroller"), view = byId("view"), spacer = byId("spacer");
  let wall = false, position = 0, scale = 1, columns = 1, chosen = 0, expected = 0, frame = 0, pool = [], moved = 0;

  const line_height = () => wall ? tile_height : row_height;
  const total_height = () => Math.ceil(count() / columns) * line_height();
  const most_position = () => Math.max(0, total_height() - scroller.clientHeight);

  function lay_out() {
    columns = wall ? Math.max(1, Math.floor(scroller.clientWidth / tile_width)) : 1;
    const height = Math.min(most_height, total_height());
    spacer.style.height = height + "px";
    scale = height > scroller.clientHeight ? most_position() / (height - scroller.clientHeight) : 1;
    const needed = (Math.ceil(scroller.clientHeight / line_height()) + 2) * columns;
    view.replaceChildren();
    pool = Array.from({ length: needed }, () => wall ? new_tile() : new_row());
    view.append(...pool.map(one => one.root));
    go_to(position);
  }
  function go_to(to) {
    position = Math.min(Math.max(0, to), most_position());
    expected = position / scale;
    scroller.scrollTop = expected;
    changed();
  }
  scroller.addEventListener("scroll", () => {
    if (Math.abs(scroller.scrollTop - expected) < 2) return;
    expected = scroller.scrollTop;
    position = Math.min(expected * scale, most_position());
    changed();
  }, { passive: true });
  scroller.addEventListener("wheel", event => {
    event.preventDefault();
    go_to(position + event.deltaY * (event.deltaMode === 1 ? row_height : event.deltaMode === 2 ? scroller.clientHeight : 1));
  }, { passive: false });

  function new_row() {
    const root = element("div", "row"), number = element("span", "number"), dots = element("span", "dots"), name = element("span", "name");
    const values = ["CAD-RADS", ...summary.measures.map(one => one.title)].map(title => { const cell = element("span", "value"); cell.title = title; return cell; });
    const verdict = element("span", "verdict");
    for (const stage of summary.stages) { const dot = element("i"); dot.title = stage.name; dots.append(dot); }
    root.append(number, dots, name, ...values, verdict);
    return { root, number, dots, name, values, verdict };
  }
  function new_tile() {
    const root = element("div", "tile"), picture = element("img"), dots = element("span", "dots"), name = element("div", "name"), verdict = element("span", "verdict");
    picture.decoding = "async";
    picture.alt = "";
    picture.onerror = () => picture.removeAttribute("src");
    for (const stage of summary.stages) { const dot = element("i"); dot.title = stage.name; dots.append(dot); }
    root.append(picture, name, dots, verdict);
    return { root, picture, dots, name, verdict };
  }
  function fill(one, scan, place) {
    const row = row_of(scan);
    one.root.classList.toggle("chosen", place === chosen);
    [...one.dots.children].forEach((dot, stage) => { dot.className = "s" + state_of(scan, stage); });
    one.name.textContent = row ? row[0] : "...";
    const review = review_of(scan);
    one.verdict.textContent = review ? (review.verdict === "ok" ? "OK" : "look again") : "";
    if (one.number) one.number.textContent = scan + 1;
    if (one.values) one.values.forEach((cell, i) => { cell.textContent = row && row[4 + i] !== null ? row[4 + i] : ""; });
    if (one.picture) show_picture(one.picture, row && picture_of(scan, row));
  }
  const stage_named = name => summary.stages.findIndex(stage => stage.name === name);
  const is_done = (scan, name) => { const state = state_of(scan, stage_named(name)); return state === 1 || state === 2; };
  function picture_of(scan, row) {
    return is_done(scan, "measures") ? "../measures/" + row[0] + "/report/images/tree.png" : null;
  }
  function show_picture(picture, source) {
    if (!source) picture.removeAttribute("src");
    else if (picture.getAttribute("src") !== source && performance.now() - moved > 120) picture.src = source;  // not while all of it flies by
  }

  function changed() {
    if (!frame) frame = requestAnimationFrame(draw);
  }
  let drawn_at = -1, timer = 0;
  function draw() {
    frame = 0;
    if (position !== drawn_at) {
      drawn_at = position;
      moved = performance.now();
      if (wall) { clearTimeout(timer); timer = setTimeout(changed, 150); }
    }
    const height = line_height(), first = Math.floor(position / height) * columns, last = count();
    for (let i = 0; i < pool.length; ++i) {
      const place = first + i, one = pool[place % pool.length];
      one.root.hidden = place >= last;
      one.root.style.display = place >= last ? "none" : "";
      if (place >= last) continue;
      const line = Math.floor(place / columns);
      one.root.style.transform = `translate(${(place - line * columns) * tile_width * (wall ? 1 : 0)}px, ${line * height - position}px)`;
      one.root.dataset.place = place;
      fill(one, scan_at(place), place);
    }
    show_detail();
  }
  view.addEventListener("click", event => {
    const at = event.target.closest("[data-place]");
    if (at) choose(Number(at.dataset.place));
  });
  function choose(place) {
    if (count() === 0) return;
    chosen = Math.min(Math.max(0, place), count() - 1);
    const height = line_height(), top = Math.floor(chosen / columns) * height;
    if (top < position) go_to(top);
    else if (top + height > position + scroller.clientHeight) go_to(top + height - scroller.clientHeight);
    changed();
  }

  // ---- beside the list --------------------------------------------------------------------------------------------
  function choice(text, is_on, act) {
    const button = element("button", is_on ? "on" : "", text);
    button.type = "button";
    button.addEventListener("click", () => { act(is_on); apply_filter(); });
    return button;
  }
  function show_side() {
    byId("counts").textContent = `${summary.scans} scans, ${summary.whole} whole` + (summary.refused ? `, ${summary.refused} rows left out` : "") +
      (shown ? `; ${shown.length} shown` : "");
    const stages = byId("stages");
    stages.replaceChildren();
    const head = stages.insertRow();
    ["", ...summary.states].forEach(text => head.append(element("th", "", text)));
    summary.stages.forEach((stage, number) => {
      const line = stages.insertRow();
      line.append(element("td", "", stage.name));
      stage.counts.forEach((scans, state) => {
        const is_on = filter.stage === number && filter.state === state, cell = line.insertCell();
        cell.append(choice(String(scans), is_on, on => { filter.stage = on ? null : number; filter.state = on ? null : state; }));
      });
    });
    const reviews = byId("reviews");
    reviews.replaceChildren();
    for (const [name, text] of [["ok", "OK"], ["again", "look again"], ["open", "not reviewed"]])
      reviews.append(choice(text, filter.review === name, on => { filter.review = on ? null : name; }));
    const reasons = byId("reasons");
    reasons.replaceChildren();
    summary.reasons.map((one, number) => [one, number]).sort(([a], [b]) => b.scans - a.scans).slice(0, 200).forEach(([one, number]) => {
      const line = reasons.insertRow();
      line.insertCell().append(choice(`${one.scans} x ${one.stage}, ${one.exit_code}: ${one.reason}`, filter.reason === number, on => { filter.reason = on ? null : number; }));
    });
    byId("measures").replaceChildren(...summary.measures.map(histogram));
  }
  function histogram(measure, number) {
    const box = element("div"), bars = element("div", "bars"), ends = element("div", "ends"), most = Math.max(1, ...measure.bins);
    measure.bins.forEach((scans, bin) => {
      const from = measure.from + bin * measure.step, is_on = filter.bins.get(number) === bin + 1;
      const bar = choice("", is_on, on => { if (on) filter.bins.delete(number); else filter.bins.set(number, bin + 1); });
      bar.style.height = 100 * scans / most + "%";
      bar.title = `${scans} scans, ${from} to ${from + measure.step} ${measure.unit}`;
      bar.disabled = scans === 0;
      bars.append(bar);
    });
    ends.append(element("span", "", measure.from), element("span", "", measure.title + (measure.unit ? ", " + measure.unit : "")),
      element("span", "", measure.from + measure.step * measure.bins.length));
    box.append(bars, ends);
    return box;
  }
  function link(text, to) {
    const made = element("a", "", text);
    made.href = to;
    return made;
  }
  let told_row = null;
  function show_detail() {
    const scan = count() ? scan_at(chosen) : -1, row = scan < 0 ? null : row_of(scan), review = scan < 0 ? null : review_of(scan);
    const key = JSON.stringify([scan, row, review]);
    if (told_row === key) return;
    told_row = key;
    const box = byId("detail");
    box.replaceChildren();
    if (!row) return;
    box.append(element("h2", "name", row[0]), element("div", "", `patient ${row[1]}, ${row[2]}`));
    if (is_done(scan, "extract")) box.append(link("case", `../cases/${row[0]}/case.ostia`), " ");
    if (is_done(scan, "measures")) box.append(link("report", `../measures/${row[0]}/report/report.html`), " ");
    if (is_done(scan, "pressure")) box.append(link("pressure", `../flow/${row[0]}/pressure/pressure.html`));
    const table = element("table");
    const add = (name, text) => { const line = table.insertRow(); line.append(element("td", "", name), element("td", "", text)); };
    summary.stages.forEach((stage, number) => add(stage.name, summary.states[state_of(scan, number)]));
    add("CAD-RADS", row[4] || "-");
    summary.measures.forEach((measure, number) => add(measure.title, row[5 + number] === null ? "-" : `${row[5 + number]} ${measure.unit}`));
    if (review) add(review.verdict === "ok" ? "OK" : "look again", `${review.reader}, ${review.time}`);
    box.append(table);
    const set = summary.sets.find(([number]) => number === set_of(scan));
    for (const reason of set ? set[1] : [])
      box.append(element("p", "", `${summary.reasons[reason].stage}: ${summary.reasons[reason].reason}`));
    const source = picture_of(scan, row);
    if (source) {
      const picture = element("img");
      picture.alt = "the tree";
      picture.onerror = () => picture.remove();
      picture.src = source;
      box.append(picture);
    }
  }

  // ---- reviews ----------------------------------------------------------------------------------------------------
  function tell(text) {
    byId("told").textContent = text;
  }
  const memory = () => "ostia-cohort-" + summary.cohort;
  function remember() {
    try { localStorage.setItem(memory(), JSON.stringify({ reader: byId("reader").value, pending: [...pending] })); } catch (error) { /* then only as long as the page is open */ }
  }
  function recall() {
    try {
      const known = JSON.parse(localStorage.getItem(memory()) || "{}");
      byId("reader").value = known.reader || "";
      for (const [scan, review] of known.pending || []) pending.set(scan, review);
    } catch (error) { /* as if nothing were known */ }
  }
  function told_pending() {
    byId("export").disabled = pending.size === 0;
    byId("export").textContent = pending.size ? `Export reviews (${pending.size})` : "Export reviews";
  }
  const document_of = reviews => JSON.stringify({ v: 1, kind: "cohort reviews", reviews });
  function judge(verdict) {
    const scan = count() ? scan_at(chosen) : -1, row = scan < 0 ? null : row_of(scan);
    if (!row) return;
    const reader = byId("reader").value.trim();
    if (!reader) { tell("Say first who you are"); byId("reader").focus(); return; }
    if (!row[3]) { tell("This scan has no case that could be reviewed"); return; }
    const review = { scan: row[0], verdict, reader, time: new Date().toISOString().slice(0, 19) + "Z", made: row[3] };
    pending.set(scan, review);
    tell("");
    if (served) send(scan, review);
    remember();
    told_pending();
    if (verdict !== "none") choose(chosen + 1);
    changed();
  }
  async function send(scan, review) {
    try {
      const answer = await fetch("../review", { method: "POST", headers: { "Content-Type": "application/json" }, body: document_of([review]) });
      if (!answer.ok) throw new Error(await answer.text());
      stored.set(scan, review);
      if (pending.get(scan) === review) pending.delete(scan);
      remember();
    } catch (error) {
      tell("Not written: " + error.message);
    }
    told_pending();
    changed();
  }
  byId("export").addEventListener("click", () => {
    const there = element("a");
    there.href = URL.createObjectURL(new Blob([document_of([...pending.values()])], { type: "application/json" }));
    there.download = "reviews.json";
    there.click();
    tell("Take it in by: ostia cohort review COHORT reviews.json");
  });

  // ---- hands ------------------------------------------------------------------------------------------------------
  function toggle_mode() {
    wall = !wall;
    byId("mode").textContent = wall ? "List (w)" : "Wall (w)";
    position = 0;
    lay_out();
    choose(chosen);
  }
  function clear() {
    Object.assign(filter, { stage: null, state: null, reason: null, review: null, search: "" });
    filter.bins.clear();
    byId("search").value = "";
    apply_filter();
  }
  const keys = { j: () => choose(chosen + 1), k: () => choose(chosen - 1), ArrowDown: () => choose(chosen + columns), ArrowUp: () => choose(chosen - columns),
    ArrowRight: () => choose(chosen + 1), ArrowLeft: () => choose(chosen - 1), PageDown: () => go_to(position + scroller.clientHeight),
    PageUp: () => go_to(position - scroller.clientHeight), Home: () => choose(0), End: () => choose(count() - 1),
    o: () => judge("ok"), a: () => judge("again"), u: () => judge("none"), w: toggle_mode, c: clear };
  document.addEventListener("keydown", event => {
    if (event.target.tagName === "INPUT" || event.ctrlKey || event.metaKey || event.altKey || !summary) return;
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  byId("mode").addEventListener("click", toggle_mode);
  byId("clear").addEventListener("click", clear);
  byId("reader").addEventListener("change", () => { if (summary) remember(); });
  byId("search").addEventListener("input", event => {
    filter.search = event.target.value.toLowerCase().replace(/^p-/, "").replace(/[^0-9a-f]/g, "").slice(0, 4);
    apply_filter();
  });
  window.addEventListener("resize", () => { if (summary) lay_out(); });

  async function start() {
    try {
      await load("summary");
      await load("reviews");
      const parts = Math.ceil(summary.scans / summary.scans_of_an_index);
      await Promise.all(Array.from({ length: parts }, (_, number) => load("index-" + number)));
      recall();
      told_pending();
      apply_filter();
      document.body.dataset.ready = "yes";
    } catch (error) {
      tell("The data beside this page cannot be read: " + error.message);
    }
  }
  document.addEventListener("DOMContentLoaded", start);

  return {
    summary(all) { summary = all; width = all.stages.length + 2 + all.measures.length + 4; },
    index(number, text) { indices[number] = text; },
    rows: keep_rows,
    reviews(all) { for (const [scan, verdict, reader, time] of all.rows) stored.set(scan, { verdict, reader: all.readers[reader], time }); },
  };
})();
