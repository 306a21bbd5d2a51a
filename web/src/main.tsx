// Starts the page: the engine in its worker, the view on its canvas, hands, and panels around it.
import { render } from "preact";
import { effect } from "@preact/signals";
import { EngineClient } from "./engine/client";
import { Playground, GHOST_REACH } from "./app/playground";
import { settings } from "./app/settings";
import { t } from "./i18n";
import { Feedback } from "./input/feedback";
import { KeyboardInput } from "./input/keyboard";
import { PointerInput } from "./input/pointer";
import { xr } from "./input/xr/session";
import { allScenes } from "./scenes/gallery";
import { sceneInLink } from "./scenes/library";
import { App, Failure } from "./ui/app";
import { PlaygroundProvider } from "./ui/context";
import { acceptScenes } from "./ui/drop";
import { offerLost, runText } from "./ui/editor";
import { cameInLink, followScene } from "./app/address";
import { keepForLater } from "./app/offline";
import { offerReadOnly } from "./app/inspection";
import "./ui/styles.css";

/** What is loaded first: the first of these that is built in. */
const FIRST_SCENES = ["hello4d", "dice4d"];

function start(): void {
  const root = document.getElementById("app");
  if (!root) return;
  const canvas = document.createElement("canvas");
  canvas.className = "view";
  canvas.tabIndex = -1;
  const client = new EngineClient();
  let playground: Playground;
  try {
    playground = new Playground(client, canvas);
  } catch {
    client.dispose();
    render(<Failure title="Hyperbody" text={t().noWebGl} />, root);
    return;
  }
  document.body.prepend(canvas);
  const fit = () => playground.quality.resize(innerWidth, innerHeight);
  addEventListener("resize", fit);
  fit();
  canvas.addEventListener("webglcontextlost", () => playground.say(t().contextLost));
  new PointerInput(playground, canvas);
  new KeyboardInput(playground);
  new Feedback(playground);
  acceptScenes(playground);
  xr.prepare(playground);
  followSettings(playground);
  followScene(playground);
  effect(() => {
    if (playground.lost.value !== null) offerLost(playground.lost.value);
  });
  addEventListener("hashchange", () => void runLink(playground));
  offerReadOnly(playground);
  keepForLater(playground);
  render(<PlaygroundProvider value={playground}><App /></PlaygroundProvider>, root);
  playground.start();
  void begin(playground);
}

/** What is drawn follows what is chosen. */
function followSettings({ stage, client }: Playground): void {
  effect(() => stage.surfaces.setMode(settings.surface.value));
  effect(() => stage.edges.setOn(settings.edges.value));
  effect(() => stage.joints.setOn(settings.joints.value));
  effect(() => client.send("ghosts", { on: settings.ghosts.value, reach: GHOST_REACH }));
  effect(() => client.send("wires", { on: settings.wires.value }));
}

async function begin(playground: Playground): Promise<void> {
  try {
    const { builtins } = await playground.client.ready();
    playground.builtins.value = builtins;
    await loadFirst(playground);
  } catch (error) {
    playground.failure.value ??= { kind: "start", message: error instanceof Error ? error.message : String(error) };
  }
}

/** The scene in the address (`#scene=…`), or named in it (`?scene=pit4d&speed=0.5`; `detail=2` fixes the pixel ratio), or the first of the gallery. */
async function loadFirst(playground: Playground): Promise<void> {
  const options = new URLSearchParams(location.search);
  playground.usualSpeed = Number(options.get("speed")) || 1;
  if (Number(options.get("detail"))) playground.quality.fix(Number(options.get("detail")));
  const names = allScenes(playground.builtins.value).map(({ name }) => name);
  const asked = options.get("scene");
  const first = [asked, ...FIRST_SCENES].find((name) => name !== null && names.includes(name)) ?? names[0];
  await runLink(playground);
  if (playground.scene.value) return;
  await playground.open(first);
  if (asked && asked !== first) playground.say(t().noScene(asked));
}

/** Runs the scene in the address, if there is one. */
async function runLink(playground: Playground): Promise<void> {
  const linked = await sceneInLink(location.hash).catch(() => {
    playground.say(t().badLink);
    return null;
  });
  if (!linked) return;
  cameInLink(linked);
  await runText(playground, linked);
}

start();
