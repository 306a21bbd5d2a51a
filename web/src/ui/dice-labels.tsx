// Numbers over dice that have come to rest: the cell on which each lies.
import { useEffect, useRef } from "preact/hooks";
import { restsOn } from "../app/dice";
import { t } from "../i18n";
import { usePlayground } from "./context";

/** Scenes with more dice than this are for looking, not for reading. */
const MOST_DICE = 16;
/** So far over the middle of a die its number stands. */
const ABOVE_PIXELS = 26;

export function DiceLabels() {
  const playground = usePlayground();
  const place = useRef<HTMLDivElement>(null);
  const dice = (playground.scene.value?.bodies ?? []).filter((body) => body.kind === "dynamic" && (body.shape === "polytope" || body.shape === "box"));
  const read = /dice/.test(playground.sceneName.value ?? "") && dice.length <= MOST_DICE;
  useEffect(() => {
    const labels = new Map<number, HTMLElement>();
    const draw = () => {
      const { frame } = playground.client;
      if (!frame || !place.current) return;
      const gravity = playground.gravity.value;
      for (const body of dice) {
        const label = labels.get(body.id) ?? place.current.appendChild(document.createElement("span"));
        labels.set(body.id, label);
        const still = frame.asleep.includes(body.id);
        const cell = still && playground.distanceOff(body.id) === null ? restsOn(frame, body.id, gravity) : null;
        const at = cell === null ? null : playground.onPage(body.id);
        label.hidden = !at;
        if (!at) continue;
        label.textContent = String(cell);
        label.title = t().restsOn(cell ?? 0);
        label.style.transform = `translate(${at.x}px, ${at.y - ABOVE_PIXELS}px) translate(-50%, -50%)`;
      }
    };
    if (read) playground.onPicture.add(draw);
    return () => {
      playground.onPicture.delete(draw);
      for (const label of labels.values()) label.remove();
    };
  });
  return read ? <div class="dice-labels" ref={place} data-testid="dice" /> : null;
}
