// The page around the view: which panels there are, and where.
import { useEffect, useRef } from "preact/hooks";
import { t } from "../i18n";
import { Compass } from "./compass";
import { usePlayground } from "./context";
import { DiceLabels } from "./dice-labels";
import { BodyPanel } from "./body-panel";
import { Editor } from "./editor";
import { Gallery } from "./gallery";
import { Help } from "./help";
import { Hint } from "./hint";
import { MorePanel } from "./more-panel";
import { BodyMenu, Notice } from "./notices";
import { OffMarker } from "./off-marker";
import { ShapePalette } from "./shape-palette";
import { sheet } from "./state";
import { Strip } from "./strip";
import { TopBar } from "./top-bar";
import { Tour } from "./tour";
import { Transport, Warnings } from "./transport";

export function App() {
  const playground = usePlayground();
  const failure = playground.failure.value;
  if (failure?.kind === "start") return <Failure title={t().noEngine} text={failure.message} hint={t().noEngineHint} />;
  if (failure) return <Failure title={t().stopped} text={t().stoppedText} hint={failure.message} again={() => void playground.startOver()} />;
  if (!playground.scene.value) return <p class="starting">{t().starting}</p>;
  return (
    <>
      {/* What lies in the world comes first: panels are above it. */}
      <OffMarker />
      <DiceLabels />
      <TopBar />
      <ShapePalette />
      <div class="side">
        <BodyPanel />
        <SliceStrips />
      </div>
      <Compass />
      <Transport />
      <Warnings />
      <Hint />
      {playground.flatland.value && <FlatlandFrame />}
      {sheet.value === "gallery" && <Gallery />}
      {sheet.value === "editor" && <Editor />}
      {sheet.value === "more" && <MorePanel />}
      {sheet.value === "help" && <Help />}
      <Tour />
      <BodyMenu />
      <Notice />
    </>
  );
}

function SliceStrips() {
  const playground = usePlayground();
  const scene = playground.scene.value;
  // Read for its sake: the number of off directions changes with scene and Flatland.
  const count = scene && (playground.flatland.value ? 1 : Math.max(0, scene.dimension - 3));
  if (!count) return null;
  return <div class="strips glass">{Array.from({ length: count }, (_, off) => <Strip key={off} off={off} />)}</div>;
}

/** The window through which one looks into the plane; the view draws into its place. */
function FlatlandFrame() {
  const playground = usePlayground();
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const measure = () => {
      const box = place.current?.getBoundingClientRect();
      if (box) playground.flat.inset = { left: box.left, top: box.top, width: box.width, height: box.height };
    };
    playground.onPicture.add(measure);
    return () => void playground.onPicture.delete(measure);
  }, [playground]);
  return (
    <figure class="flatland">
      <div ref={place} />
      <figcaption><b>{t().flatland}</b> {t().flatlandHint}</figcaption>
    </figure>
  );
}

/** In place of everything: what is missing, and what helps. */
export function Failure({ title, text, hint, again }: { title: string; text: string; hint?: string; again?: () => void }) {
  return (
    <div class="failure" role="alert">
      <h1>{title}</h1>
      <p>{text}</p>
      {hint && <p class="hint">{hint}</p>}
      {again && <button type="button" class="button text primary" onClick={again}>{t().startOver}</button>}
    </div>
  );
}
