// One line for the first minute of a newcomer; gone for good once something was pulled or the slice was moved.
import { useEffect } from "preact/hooks";
import { isBoolean, kept } from "../app/settings";
import { t } from "../i18n";
import { usePlayground } from "./context";
import { tourStep } from "./state";

const seen = kept("hint-seen", false, isBoolean);
const MOVED_OFF = 0.25;

export function Hint() {
  const playground = usePlayground();
  useEffect(() => {
    const watch = () => {
      if (seen.value) return;
      const pulled = (playground.client.frame?.hands.length ?? 0) > 0;
      if (pulled && Math.abs(playground.slice.offset()) > MOVED_OFF) seen.value = true;
    };
    playground.onFrame.add(watch);
    return () => void playground.onFrame.delete(watch);
  }, [playground]);
  if (seen.value || tourStep.value !== null || playground.slice.offCount === 0 || playground.flatland.value) return null;
  // On narrow screens the panel of a selected body has its place.
  if (playground.selected.value !== null && matchMedia("(max-width: 759px)").matches) return null;
  const words = matchMedia("(pointer: coarse)").matches ? t().hintTouch : t().hintMouse;
  return (
    <p class="hint-line glass">
      {words}
      <button type="button" class="button" aria-label={t().close} onClick={() => (seen.value = true)}>×</button>
    </p>
  );
}
