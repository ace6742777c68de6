// The page in a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { affinor, ask, needsCommand, open, settled, text, violations } from "./browser.mjs";

test("the first report is the comparison of the paper", async () => {
  const page = await open();
  assert.match(await text(page, "result"), /Claims of the paper/);
  assert.ok((await page.locator("#result math").count()) > 20);
  assert.deepEqual([page.foreign, page.problems], [[], []]);
});

test("a space, a connection and a metric make a table, a link and a way back", async () => {
  const page = await open("#report=table&space=so3&connection=zero&show=ricci");
  assert.ok(await page.locator('#result math[alttext^="Ric_11 ="]').count());
  await page.fill("#space", "sl(2)");
  await page.click("button[type=submit]");
  await settled(page);
  assert.match(page.url(), /space=sl%282%29/);
  const shared = await open(new URL(page.url()).hash);
  assert.equal(await text(shared, "result"), await text(page, "result"));
  await page.goBack();
  await settled(page);
  assert.equal(await page.inputValue("#space"), "so3");
  assert.match(await text(page, "result"), /so\(3\)/);
  await page.goForward();
  await settled(page);
  assert.equal(await page.inputValue("#space"), "sl(2)");
});

test("the slider of lambda moves the connection and leaves one entry of history", async () => {
  const page = await open("#report=table&space=so3&connection=zero&show=curvature");
  const length = await page.evaluate(() => history.length);
  await page.focus("#lambda");
  for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.equal(await page.inputValue("#connection"), "lambda=2/3");
  // lambda (1 - lambda) = 2/9
  assert.ok(await page.locator('#result math[alttext$="= 2/9"]').count());
  assert.equal(await page.evaluate(() => history.length), length);
});

test("every report, and its copies", async () => {
  for (const report of ["compare", "table", "check", "info", "properties", "equations", "list", "conventions"]) {
    const space = { compare: "so3@plus&other=so3@zero", list: "so" }[report] ?? "so3&connection=zero&metric=diag(1,2,3)";
    const page = await open(`#report=${report}&space=${space}`);
    assert.equal(await text(page, "error"), "", report);
    assert.ok((await text(page, "result")).length > 100, report);
    await page.context().close();
  }
  const page = await open("#report=table&space=so3@zero&show=torsion", { permissions: ["clipboard-read", "clipboard-write"] });
  for (const [format, part] of [["latex", "\\tau"], ["csv", "tensor,i,j,k,l,value"], ["json", "affinor.table/1"], ["markdown", "## Torsion"]]) {
    await page.click(`#copies button:text-is("${format}")`);
    await page.waitForFunction((format) => document.getElementById("status").textContent === `copied as ${format}`, format);
    assert.ok((await page.evaluate(() => navigator.clipboard.readText())).includes(part), format);
  }
});

test("a definition of one's own, with a message under the letters", async () => {
  const page = await open("#report=table&show=ricci");
  await page.click("#own summary");
  await page.fill("#definition", 'basis = ["x", "y"]\nbrackets = "[x, q] = y"');
  await page.click("button[type=submit]");
  await settled(page);
  const error = await text(page, "error");
  assert.match(error, /definition\.toml, line 2/);
  assert.match(error, /\n +\^/);
  await page.fill("#definition", 'basis = ["x", "y"]\nbrackets = "[x, y] = y"\nmetric = "identity"');
  await page.click("button[type=submit]");
  await settled(page);
  assert.equal(await text(page, "error"), "");
  assert.ok(await page.locator('#result math[alttext$="= -1"]').count());
});

test("a message stands under the letters while they are typed, and goes when they are right", async () => {
  const page = await open("#report=table&show=ricci");
  await page.click("#own summary");
  await page.focus("#definition");
  await page.keyboard.insertText('basis = ["x", "y"]\nbrackets = "[x, q] = y"');
  await page.waitForFunction(() => /line 2[^]*\n +\^/.test(document.getElementById("error").textContent));
  const end = await page.evaluate(() => document.getElementById("definition").value.length);
  assert.equal(await page.evaluate(() => document.getElementById("definition").selectionStart), end, "the cursor stays");
  for (let k = 0; k < '] = y"'.length; k++) await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Backspace");
  await page.keyboard.type("y");
  await page.waitForFunction(() => document.getElementById("error").textContent === "");
  // Jacobi fails: [x, [y, z]] = 0 + [x, y] and no other double bracket
  await page.fill("#definition", 'basis = ["x", "y", "z"]\nbrackets = """\n[x, y] = z\n[y, z] = y\n"""');
  await page.waitForFunction(() => document.getElementById("error").textContent.includes("Jacobi"));
});

test("the metric as a grid: symbols in symmetric places, the field and the table follow", async () => {
  const page = await open("#report=table&space=sl(2)&metric=diag(a,1,2)&show=metric");
  await page.click("#grid-field summary");
  await page.waitForSelector("#grid input");
  assert.deepEqual(await page.locator("#grid input").evaluateAll((all) => all.map(({ value }) => value)), ["a", "0", "0", "0", "1", "0", "0", "0", "2"]);
  await page.locator("#grid input").nth(1).fill("b");
  await settled(page);
  assert.equal(await page.inputValue("#metric"), "[[a, b, 0], [b, 1, 0], [0, 0, 2]]");
  assert.match(decodeURIComponent(page.url()), /metric=\[\[a, b/);
  assert.equal(await page.locator("#grid input").nth(3).inputValue(), "b");
  assert.ok(await page.locator('#result math[alttext$="= b"]').count());
  assert.deepEqual(await violations(page), []);
  // an entry that is half written leaves a message, and the grid
  await page.locator("#grid input").nth(8).fill("2/");
  await page.waitForFunction(() => document.getElementById("error").textContent !== "");
  await page.locator("#grid input").nth(8).fill("2/3");
  await settled(page);
  assert.equal(await text(page, "error"), "");
  await page.fill("#space", "E6");
  await page.click("button[type=submit]");
  await page.waitForFunction(() => document.getElementById("grid").textContent.includes("78"));
  assert.deepEqual(page.problems, []);
});

test("matrices, structure constants, a chart, and a file that is dropped", async () => {
  const own = {
    matrices: 'basis = ["h", "x", "y"]\nmatrices = [[[1, 0], [0, -1]], [[0, 1], [0, 0]], [[0, 0], [1, 0]]]',
    constants: "dimension = 3\nstructure_constants = [[1, 2, 3, 1], [2, 1, 3, -1]]",
    chart: 'metric = [["1", "0"], ["0", "sin(t)^2"]]\n[chart]\ncoordinates = ["t", "p"]',
  };
  const shown = { matrices: "killing", constants: "structure", chart: "scalar_curvature" };
  for (const [kind, definition] of Object.entries(own)) {
    const show = shown[kind];
    const page = await open(`#report=table&show=${show}`);
    // dropped, as a file
    await page.evaluate(([definition, kind]) => {
      const data = new DataTransfer();
      data.items.add(new File([definition], `${kind}.toml`));
      document.getElementById("own").dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    }, [definition, kind]);
    await page.waitForFunction(() => document.getElementById("definition").value !== "");
    await settled(page);
    assert.equal(await text(page, "error"), "", kind);
    assert.ok((await page.locator("#result math").count()) > 0, kind);
    await page.context().close();
  }
});

test("sixty wrong inputs leave a message and a living page", async () => {
  const page = await open("#report=table&space=so3");
  const bad = ["so33", "", "so(", "E9", "so(3,", "heisenberg(4)", "A0", "sl(1)", "x.toml", "/etc/passwd", "so3@", "so3@nonsense", "so3@lambda=", "so3@zero;metric=", "so3+", "+so3", "R^", "R^99999999999", "so(2000)", "ß", "\u0000", "so3@levi-civita", "M4", "[x,y=z", "-"];
  const metrics = ["diag(1,2)", "diag(1,2,3", "nonsense(1)", "[[1,0],[0,1]]", "[[1,2,0],[0,1,0],[0,0,1]]", "diag(0,1,1)", "diag(1/0,1,1)", "1e999999999", "diag(NaN,1,1)", "diag(a..b,1,1)", "((((((((((", "diag()", "🙂"];
  const connections = ["left", "lambda=", "lambda=1/0", "lambda=x y", "levi civita", "plus zero", "lambda=1e99999999"];
  const sets = ["a", "a=", "=1", "a=1,a=2", "b=1", "a=1/0", ","];
  const shows = ["torsions", "ricci,,", "x".repeat(500), "weyl;ricci", "RICCI", "kretschmann2", "-", "0"];
  let count = 0;
  const refuse = async (fields) => {
    await page.evaluate((hash) => { location.hash = hash; }, new URLSearchParams({ report: "table", ...fields }).toString());
    await page.waitForFunction(() => document.getElementById("error").textContent !== "", undefined, { timeout: 20000 })
      .catch(() => { throw new Error(`no message for ${JSON.stringify(fields)}`); });
    count += 1;
    await page.evaluate(() => { location.hash = "#report=table&space=so3&show=killing"; });
    await page.waitForFunction(() => document.getElementById("error").textContent === "" && document.querySelector('#result math[alttext^="K_11 ="]'));
  };
  for (const space of bad) await refuse({ space });
  for (const metric of metrics) await refuse({ space: "so3", metric });
  for (const connection of connections) await refuse({ space: "so3", connection });
  for (const set of sets) await refuse({ space: "so3", metric: "diag(a,a,a)", set });
  for (const show of shows) await refuse({ space: "so3", show });
  assert.ok(count >= 60, String(count));
  assert.deepEqual(page.problems, []);
});

test("long work can be stopped, and the input is kept", async () => {
  const page = await open("#report=table&space=so3");
  await page.fill("#space", "E8");
  await page.fill("#connection", "levi-civita");
  await page.fill("#metric", "identity");
  await page.click("button[type=submit]");
  await page.waitForFunction(() => document.getElementById("status").textContent.includes("computing"));
  await page.click("#stop");
  await page.waitForFunction(() => document.getElementById("status").textContent === "stopped");
  assert.equal(await page.inputValue("#space"), "E8");
  await page.fill("#space", "so3");
  await page.fill("#show", "ricci");
  await page.click("button[type=submit]");
  await settled(page);
  assert.ok(await page.locator('#result math[alttext^="Ric_11 ="]').count());
});

test("long work shows its stages and the seconds", async () => {
  const page = await open("#report=table&space=so3");
  const stages = await page.evaluate(async () => {
    const status = document.getElementById("status"), seen = [];
    const watch = new MutationObserver(() => seen.push(status.textContent));
    watch.observe(status, { childList: true, characterData: true, subtree: true });
    document.getElementById("space").value = "E6";
    document.getElementById("show").value = "curvature";
    document.getElementById("form").requestSubmit();
    await new Promise((resolve) => { const timer = setInterval(() => { if (/\d+ ms/.test(status.textContent) && seen.length) { clearInterval(timer); resolve(); } }, 50); });
    return seen;
  });
  assert.ok(stages.includes("computing: curvature"), stages.join(", "));
  // 21 letters: minutes
  const metric = Array.from({ length: 6 }, (_, i) => Array.from({ length: 6 }, (_, j) => `a${Math.min(i, j) + 1}${Math.max(i, j) + 1}`));
  await page.fill("#space", "se3");
  await page.fill("#connection", "levi-civita");
  await page.fill("#metric", `[${metric.map((row) => `[${row}]`)}]`);
  await page.click("button[type=submit]");
  await page.waitForFunction(() => document.getElementById("seconds").textContent === "1 s");
  assert.deepEqual(await violations(page), []);
  await page.click("#stop");
  await page.waitForFunction(() => document.getElementById("wait").hidden);
});

test("it works without a network once it is loaded", async () => {
  const page = await open("#report=table&space=so3");
  await page.context().setOffline(true);
  await page.fill("#space", "se(2)");
  await page.click("button[type=submit]");
  await settled(page);
  assert.match(await text(page, "result"), /se\(2\)/);
});

test("an address that is not understood leaves a message", async () => {
  const page = await open("#report=tabel&space=so3&colour=red");
  assert.match(await text(page, "error"), /report=tabel, colour/);
});

test("no violation of accessibility, no sideways scroll", async () => {
  const body = "space=so3&connection=levi-civita&metric=diag(1,2,3)";
  const states = ["", "#report=table&space=so3@zero", "#report=info&space=se(3)", "#report=info&space=E6", "#report=table&space=nothing", `#report=table&${body}`, `#report=check&${body}`,
    `#report=properties&${body}`, `#report=equations&${body}`, "#report=list", "#report=conventions", "#report=transport", "#report=motion"];
  for (const [width, colorScheme] of [[360, "light"], [360, "dark"], [800, "dark"], [1600, "light"], [3840, "dark"]]) {
    const page = await open("", { viewport: { width, height: 900 }, colorScheme });
    for (const hash of states) {
      await page.evaluate((hash) => { location.hash = hash || "#report=compare"; }, hash);
      await settled(page);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} ${hash}`);
      // colours and names do not depend on the width
      if ([360, 1600].includes(width)) assert.deepEqual(await violations(page), [], `${width} ${colorScheme} ${hash}`);
    }
    await page.context().close();
  }
});

test("the values of the program", needsCommand, async () => {
  const page = await open();
  const names = JSON.parse(affinor("list", "--format", "json")).spaces.map(({ example }) => example);
  const show = "structure,torsion,killing";
  const answers = await ask(page, names.map((space) => ({ report: "table", space, show, format: "json" })));
  names.forEach((space, at) => assert.equal(answers[at].text, affinor("table", space, "--show", show, "--format", "json"), space));
});

test("a refusal stays, and what stands below it is marked and not copied", async () => {
  const page = await open("#report=equations&space=so3&metric=diag(1,2,3)");
  await page.focus("#metric");
  await page.keyboard.press("Control+A");
  await page.keyboard.press("Delete");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.getElementById("error").textContent.includes("need a metric"));
  // longer than the pause before what is typed is checked
  await page.waitForTimeout(500);
  await settled(page);
  assert.match(await text(page, "error"), /need a metric/);
  assert.ok(await page.locator("#before").isVisible());
  assert.equal(await page.locator("#copies button:enabled").count(), 0);
  await page.fill("#space", "so33");
  await page.press("#space", "Enter");
  await settled(page);
  assert.ok(await page.locator("#before").isVisible());
  await page.fill("#space", "so3");
  await page.fill("#metric", "identity");
  await page.press("#metric", "Enter");
  await settled(page);
  assert.equal(await text(page, "error"), "");
  assert.ok(await page.locator("#before").isHidden());
  assert.equal(await page.locator("#copies button:disabled").count(), 0);
  assert.deepEqual(page.problems, []);
});

test("an entry of the grid is typed letter by letter, and a space shows its own metric", async () => {
  const page = await open("#report=table&space=so3&metric=diag(1,1,2)&show=metric");
  await page.click("#grid-field summary");
  await page.waitForSelector("#grid input");
  for (const [at, entry] of [[8, "2/3"], [1, "-1/2"]]) {
    await page.locator("#grid input").nth(at).click();
    await page.keyboard.press("Control+A");
    await page.keyboard.type(entry, { delay: 120 });
    await settled(page);
    assert.equal(await page.locator("#grid input").nth(at).inputValue(), entry);
  }
  assert.equal(await page.inputValue("#metric"), "[[1, -1/2, 0], [-1/2, 1, 0], [0, 0, 2/3]]");
  assert.equal(await text(page, "error"), "");
  await page.fill("#metric", "");
  await page.fill("#space", "so3@levi-civita;metric=diag(1,2,a)");
  await page.press("#space", "Enter");
  await settled(page);
  assert.deepEqual(await page.locator("#grid input").evaluateAll((all) => all.map(({ value }) => value)), ["1", "0", "0", "0", "2", "0", "0", "0", "a"]);
});

test("a copy does not end a computation, and says when it is stopped", async () => {
  const page = await open("#report=table&space=so3@zero&show=torsion", { permissions: ["clipboard-read", "clipboard-write"] });
  await page.fill("#space", "E7@zero");
  await page.fill("#show", "curvature");
  await page.press("#show", "Enter");
  assert.equal(await page.locator("#copies button:enabled").count(), 0);
  await settled(page);
  await page.click('#copies button:text-is("json")');
  await page.click("#stop");
  await settled(page);
  assert.equal(await text(page, "status"), "stopped");
  assert.equal(await text(page, "error"), "");
  await page.click('#copies button:text-is("csv")');
  await page.waitForFunction(() => document.getElementById("status").textContent === "copied as csv");
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /^tensor,.*\ncurvature,/);
});

test("reports without a file have no copy as a file", async () => {
  const page = await open("#report=list");
  const enabled = () => page.locator("#copies button:enabled").allInnerTexts();
  assert.deepEqual(await enabled(), ["latex", "markdown", "csv", "json", "text"]);
  await page.check("input[value=conventions]");
  await settled(page);
  assert.deepEqual(await enabled(), ["latex", "markdown", "csv", "json", "text"]);
});

test("the history keeps what an address has no room for, and the fields of other reports", async () => {
  const page = await open("#report=table&space=so3&connection=zero&metric=diag(1,2,3)&show=ricci");
  await page.check("input[value=info]");
  await settled(page);
  await page.check("input[value=table]");
  await settled(page);
  assert.deepEqual([await page.inputValue("#connection"), await page.inputValue("#show")], ["zero", "ricci"]);
  await page.goBack();
  await settled(page);
  await page.check("input[value=table]");
  await settled(page);
  assert.equal(await page.inputValue("#metric"), "diag(1,2,3)");
  const long = `basis = ["x", "y"]\nbrackets = "[x, y] = y"\nconnection = "zero"\n# ${"long ".repeat(8000)}`;
  await page.fill("#metric", "");
  await page.click("#own summary");
  await page.fill("#definition", long);
  await page.click("button[type=submit]");
  await settled(page);
  assert.match(await text(page, "status"), /the definition is too long for a link/);
  assert.ok(await page.locator("#space").isDisabled());
  await page.reload();
  await settled(page);
  assert.equal(await page.inputValue("#definition"), long);
  assert.match(await text(page, "result"), /\[x, y\]|x, y/);
  assert.deepEqual(page.problems, []);
});

test("a sum in an address is one, with a plain plus", async () => {
  const page = await open("#report=info&space=so3+R^3");
  assert.equal(await page.inputValue("#space"), "so3+R^3");
  assert.equal(await text(page, "error"), "");
  assert.match(decodeURIComponent(page.url()), /so3\+R\^3/);
});

test("without a network a report ends in a message, and the next one loads", async () => {
  const page = await open("#report=table&space=so3@zero&show=torsion");
  await page.context().setOffline(true);
  await page.check("input[value=transport]");
  await settled(page);
  assert.match(await text(page, "error"), /did not load/);
  await page.context().setOffline(false);
  await page.click("button[type=submit]");
  await settled(page);
  assert.equal(await text(page, "error"), "");
  assert.ok(await page.locator("#view svg").count());
  assert.deepEqual(page.problems, []);
});

test("the engine is asked for again if it did not load", async () => {
  const page = await open("#report=table&space=so3@zero&show=torsion");
  await page.route("**/*.wasm", (route) => route.abort());
  await page.fill("#space", "E8");
  // in the page, where no report ends between the clicks
  await page.evaluate(() => new Promise((resolve) => {
    const stop = document.getElementById("stop");
    new MutationObserver((_, observer) => {
      if (stop.disabled) return;
      observer.disconnect();
      stop.click();
      resolve();
    }).observe(stop, { attributes: true });
    document.querySelector("button[type=submit]").click();
  }));
  await page.waitForTimeout(300);
  await page.fill("#space", "sl2");
  await page.click("button[type=submit]");
  await settled(page);
  assert.match(await text(page, "error"), /did not load/);
  await page.unroute("**/*.wasm");
  await page.click("button[type=submit]");
  await settled(page);
  assert.equal(await text(page, "error"), "");
  assert.match(await text(page, "result"), /sl/);
});

test("a late module draws nothing over another report", async () => {
  const page = await open("#report=table&space=so3@zero&show=torsion");
  await page.route("**/transport.js", async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 1000));
    await route.continue();
  });
  await page.check("input[value=transport]");
  await page.waitForTimeout(200);
  await page.check("input[value=info]");
  await page.waitForTimeout(1500);
  await settled(page);
  assert.equal(await page.locator("#view svg").count(), 0);
  assert.match(await text(page, "result"), /semisimple/);
});
