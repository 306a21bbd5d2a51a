// Where the selected body has gone when it left the slice: a mark at its place beside the slice, warm or cool, with the
// distance. A press goes after it. So nothing that is let go of is lost.
import { useEffect, useRef } from "preact/hooks";
import { t } from "../i18n";
import { COOL, WARM } from "../view/palette";
import { offName } from "./axes";
import { usePlayground } from "./context";

/** Distances below this have a second digit, m. */
const NEAR = 0.1;

export function OffMarker() {
  const playground = usePlayground();
  const mark = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    const place = () => {
      const element = mark.current;
      const body = playground.selected.value;
      if (!element) return;
      const far = body === null ? null : playground.distanceOff(body);
      const at = far === null || body === null ? null : playground.onPage(body);
      element.hidden = !at || !far;
      if (!at || !far) return;
      const { off, away } = far;
      const [x, y] = [Math.max(40, Math.min(innerWidth - 40, at.x)), Math.max(70, Math.min(innerHeight - 150, at.y))];
      element.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
      element.style.setProperty("--side", away > 0 ? WARM : COOL);
      element.textContent = `${offName(playground.slice.frame, off)} ${away > 0 ? "+" : "−"}${Math.abs(away).toFixed(Math.abs(away) < NEAR ? 2 : 1)} m`;
    };
    playground.onPicture.add(place);
    return () => void playground.onPicture.delete(place);
  }, [playground]);
  const go = () => playground.selected.value !== null && playground.goTo(playground.selected.value);
  return <button type="button" class="off-marker" ref={mark} hidden aria-label={t().goThere} title={t().goThere} onClick={go} />;
}
