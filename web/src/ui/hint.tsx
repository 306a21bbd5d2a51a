// One line for the first minute of a newcomer; gone for good once something was pulled or the slice was moved.
import { useEffect } from "preact/hooks";
import { isBoolean, kept } from "../app/settings";
import { t } from "../i18n";
import { usePlayground } from "./context";
import { tourStep } from "./state";

const seen = kept("hint-seen", false, isBoolean);
const seenPlain = kept("hint-plain-seen", false, isBoolean);
const MOVED_OFF = 0.25;

export function Hint() {
  const playground = usePlayground();
  useEffect(() => {
    const watch = () => {
      const pulled = (playground.client.frame?.hands.length ?? 0) > 0;
      const moved = playground.slice.offCount === 0 || Math.abs(playground.slice.offset()) > MOVED_OFF;
      // A world without a fourth direction has less to say: who comes to one that has it is told the rest.
      if (pulled && moved) (playground.slice.offCount === 0 ? seenPlain : seen).value = true;
    };
    playground.onFrame.add(watch);
    return () => void playground.onFrame.delete(watch);
  }, [playground]);
  // Read for its sake: the slice is another one with every scene.
  const plain = playground.scene.value !== null && playground.slice.offCount === 0;
  if (seen.value || (plain && seenPlain.value) || tourStep.value !== null || playground.flatland.value) return null;
  // On narrow screens the panel of a selected body has its place.
  if (playground.selected.value !== null && matchMedia("(max-width: 759px)").matches) return null;
  const touch = matchMedia("(pointer: coarse)").matches;
  const words = plain ? (touch ? t().hintPlainTouch : t().hintPlainMouse) : touch ? t().hintTouch : t().hintMouse;
  return (
    <p class="hint-line glass">
      {words}
      <button type="button" class="button" aria-label={t().close} onClick={() => ((plain ? seenPlain : seen).value = true)}>×</button>
    </p>
  );
}
