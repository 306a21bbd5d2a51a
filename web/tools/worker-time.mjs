// What a frame costs the worker in a browser: processor time of its thread, from Chromium's trace, so that other work on the
// machine does not count. The world is the pile of the tests, in slow motion, so that every frame has just one step.
// `node tools/worker-time.mjs [COUNT [MOST_MS]]`; with a bound, it fails where the mean frame takes longer. The page has to be built.
import { DESKTOP, launch, open, serve, until } from "../tests/support.mjs";
import { pile } from "../tests/engine/pile.mjs";

const [count = 200, most = Infinity] = process.argv.slice(2).map(Number);
/** In which steps it is watched: from when the lower layers have landed. */
const [FROM_STEP, STEPS] = [80, 240];
const CATEGORIES = ["toplevel", "__metadata"];

/** Everything that a trace of so long holds, while `during` runs. */
async function traced(browser, during) {
  const session = await browser.newBrowserCDPSession();
  const events = [];
  session.on("Tracing.dataCollected", ({ value }) => events.push(...value));
  const complete = new Promise((resolve) => session.once("Tracing.tracingComplete", resolve));
  await session.send("Tracing.start", { transferMode: "ReportEvents", traceConfig: { recordMode: "recordAsMuchAsPossible", includedCategories: CATEGORIES } });
  await during();
  await session.send("Tracing.end");
  await complete;
  return events;
}

/** Processor time of the worker's outermost tasks, ms. */
function workerMs(events) {
  const worker = events.find(({ name, args }) => name === "thread_name" && args.name.startsWith("DedicatedWorker"));
  const tasks = events.filter(({ ph, pid, tid, tdur }) => ph === "X" && tdur !== undefined && pid === worker?.pid && tid === worker?.tid).sort((a, b) => a.ts - b.ts);
  let [end, sum] = [-Infinity, 0];
  for (const { ts, dur, tdur } of tasks) {
    if (ts < end) continue;
    end = ts + dur;
    sum += tdur / 1000;
  }
  return sum;
}

const [browser, server] = await Promise.all([launch(), serve()]);
try {
  const context = await browser.newContext({ ...DESKTOP, viewport: { width: 640, height: 400 } });
  const { page } = await open(context, server.address, { scene: "hello4d", query: "&detail=1" });
  await page.evaluate((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], "pile.json", { type: "application/json" }));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
  }, pile(count));
  const frame = () => page.evaluate(() => ({ step: window.hyperbody.frame.step, number: window.hyperbody.frame.number }));
  const reach = (bodies, step) => until(page, ([wanted, least]) => window.hyperbody.scene?.bodies.length === wanted && window.hyperbody.frame.step >= least, [bodies, step], 120_000);
  await reach(count + 1, FROM_STEP);
  await page.keyboard.press(",");
  let [before, after] = [await frame(), null];
  const events = await traced(browser, async () => {
    before = await frame();
    await reach(count + 1, before.step + STEPS);
    after = await frame();
  });
  const frames = after.number - before.number;
  const mean = workerMs(events) / frames;
  console.log(`${count} tesseracts in a pile: ${mean.toFixed(2)} ms of the worker's processor time a frame, over ${frames} frames of ${after.step - before.step} steps`);
  if (!(mean > 0) || after.step - before.step < frames) throw new Error("nothing was measured");
  if (mean > most) throw new Error(`a frame may take ${most} ms`);
} finally {
  await browser.close();
  server.close();
}
