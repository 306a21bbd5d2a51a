// The guided tour: two minutes in which the world shows itself. Each step sets the scene, moves the slice, says one or two
// sentences, and leaves the hands free.
import { useEffect, useRef } from "preact/hooks";
import type { Load, Playground } from "../app/playground";
import { calm } from "../app/settings";
import { t } from "../i18n";
import type { Words } from "../i18n/en";
import { allScenes } from "../scenes/gallery";
import { usePlayground } from "./context";
import { sheet, tourStep } from "./state";

interface Step {
  words: keyof Words["tourSteps"];
  seconds: number;
  /** Scenes by preference: the first that is built in is loaded; none: the running one goes on. */
  scenes?: readonly string[];
  /** What it speaks of: a selector, or a body that can be taken. */
  shows?: string;
  act?: (playground: Playground) => void;
  /** Called with the seconds since the step began, many times a second. */
  during?: (playground: Playground, elapsed: number) => void;
}

const SWEEP = 1.1;
const A_BODY = "body";

const STEPS: readonly Step[] = [
  { words: "welcome", seconds: 9, scenes: ["hello4d", "dice4d"] },
  { words: "slice", seconds: 13, shows: ".strip", during: (playground, elapsed) => playground.slice.moveTo(SWEEP * Math.sin((2 * Math.PI * elapsed) / 12)) },
  { words: "strip", seconds: 11, shows: ".strip", act: (playground) => playground.slice.moveTo(0) },
  { words: "ghosts", seconds: 11, during: (playground, elapsed) => playground.slice.moveTo(0.6 * Math.sin((2 * Math.PI * elapsed) / 10)) },
  { words: "grab", seconds: 14, shows: A_BODY, act: (playground) => playground.slice.moveTo(0) },
  { words: "turn", seconds: 13, shows: ".compass .knob", act: (playground) => playground.slice.quarter(0, 0, 1), during: turnBackAndForth },
  { words: "home", seconds: 8, shows: ".compass-buttons button", act: (playground) => playground.slice.home() },
  { words: "dice", seconds: 13, scenes: ["dice4d"], shows: ".strip", during: (playground, elapsed) => playground.slice.moveTo(0.5 * Math.sin((2 * Math.PI * elapsed) / 9)) },
  { words: "flatland", seconds: 14, scenes: ["flatland_solids3d", "dominoes3d"], shows: ".flatland", act: (playground) => playground.setFlatland(true), during: (playground, elapsed) => playground.slice.moveTo(Math.sin(elapsed / 2)) },
  { words: "tumble", seconds: 12, scenes: ["tumble4d"] },
  { words: "end", seconds: 8, shows: ".top-actions button", scenes: ["hello4d", "dice4d"] },
];

function turnBackAndForth(playground: Playground, elapsed: number): void {
  const wanted = (Math.PI / 4) * Math.sin((2 * Math.PI * elapsed) / 9);
  const now = Math.atan2(playground.slice.frame.rows[0][playground.slice.frame.shown] ?? 0, playground.slice.frame.rows[0][0]);
  if (elapsed > 1) playground.slice.turnBy(0, 0, (wanted - now) * 0.06);
}

/** What ran when the tour began. */
let before: Promise<Load | null> | null = null;

/** Notes what runs, or brings it back. */
function keepOrBringBack(playground: Playground, running: boolean): void {
  if (running) before ??= playground.now().catch(() => null);
  else if (before) {
    const kept = before;
    before = null;
    void kept.then((load) => load && playground.goBackTo({ ...load, again: false }));
  }
}

export function Tour() {
  const playground = usePlayground();
  const index = tourStep.value;
  useEffect(() => keepOrBringBack(playground, index !== null), [index === null, playground]);
  useEffect(() => {
    if (index === null) return;
    sheet.value = null;
    return run(playground, STEPS[index], () => (tourStep.value = index + 1 < STEPS.length ? index + 1 : null));
  }, [index, playground]);
  if (index === null) return null;
  const { shows } = STEPS[index];
  return (
    <>
      {shows && <Ring around={shows} />}
      <div class="tour glass" role="dialog" aria-live="polite" aria-label={t().tour}>
        <p>{t().tourSteps[STEPS[index].words]}</p>
        <footer>
          <span class="dots" aria-hidden="true">{STEPS.map((step, i) => <i key={step.words} class={i === index ? "on" : ""} />)}</span>
          <button type="button" class="button text" onClick={() => (tourStep.value = null)}>{t().tourSteps.skip}</button>
          <button type="button" class="button text primary" onClick={() => (tourStep.value = index + 1 < STEPS.length ? index + 1 : null)}>{t().tourSteps.nextStep}</button>
        </footer>
      </div>
    </>
  );
}

/** Space between a ring and what it is around; half the side of one around a body, CSS pixels. */
const RING_ROOM = 5;
const BODY_RING = 46;

/** A ring around what the tour speaks of, wherever that moves. */
function Ring({ around }: { around: string }) {
  const playground = usePlayground();
  const ring = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const place = () => {
      const box = around === A_BODY ? bodyBox(playground) : document.querySelector(around)?.getBoundingClientRect();
      if (!ring.current) return;
      ring.current.hidden = !box || box.width === 0;
      if (!box) return;
      const { style } = ring.current;
      [style.left, style.top, style.width, style.height] = [box.x - RING_ROOM, box.y - RING_ROOM, box.width + 2 * RING_ROOM, box.height + 2 * RING_ROOM].map((length) => `${length}px`);
    };
    playground.onPicture.add(place);
    return () => void playground.onPicture.delete(place);
  }, [around, playground]);
  return <div class={`ring ${around === A_BODY ? "round" : ""}`} ref={ring} hidden aria-hidden="true" />;
}

/** Around what is held, or the first body in the picture that can be. */
function bodyBox(playground: Playground): DOMRect | null {
  const ranges = playground.client.frame?.surface.ranges ?? [];
  const cut = Array.from({ length: ranges.length / 3 }, (_, k) => ranges[3 * k]).filter((body) => playground.body(body)?.kind === "dynamic");
  const body = cut.find((each) => each === playground.selected.value) ?? cut[0];
  const place = body === undefined ? null : playground.onPage(body);
  return place && new DOMRect(place.x - BODY_RING, place.y - BODY_RING, 2 * BODY_RING, 2 * BODY_RING);
}

/** Runs a step; what is returned ends it early. */
function run(playground: Playground, step: Step, next: () => void): () => void {
  let ended = false;
  let began = performance.now();
  const tick = () => {
    // Who asked for less motion turns the pages, and nothing moves by itself.
    if (calm.value) return;
    const elapsed = (performance.now() - began) / 1000;
    step.during?.(playground, elapsed);
    if (elapsed > step.seconds) next();
  };
  const begin = () => {
    if (ended) return;
    began = performance.now();
    if (playground.paused.value) playground.setPaused(false);
    step.act?.(playground);
    playground.onPicture.add(tick);
  };
  const scene = step.scenes?.find((name) => allScenes(playground.builtins.value).some((each) => each.name === name));
  if (scene) void playground.open(scene).then(begin);
  else begin();
  return () => {
    ended = true;
    playground.onPicture.delete(tick);
  };
}
