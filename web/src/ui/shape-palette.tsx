// Things to throw in: one tap adds a body above the middle of the view.
import { shapesFor } from "../scenes/shapes";
import { t } from "../i18n";
import { usePlayground } from "./context";
import { byHand, IconButton } from "./icons";
import { shapesOpen } from "./state";

export function ShapePalette() {
  const playground = usePlayground();
  const dimension = playground.scene.value?.dimension;
  if (!dimension) return null;
  return (
    <nav class={`shapes glass ${shapesOpen.value ? "open" : ""}`} aria-label={t().shapes}>
      <IconButton icon="plus" label={t().shapes} kind="shapes-toggle" pressed={shapesOpen.value} onPress={() => (shapesOpen.value = !shapesOpen.value)} />
      <div class="shape-list">
        {shapesFor(dimension).map(({ name, icon, shape }) => {
          const label = t().shape[name];
          return (
            <button key={name} type="button" class="button shape" title={label} aria-label={`${t().shapes}: ${label}`} data-shape={name} onClick={byHand(() => void playground.spawn(shape, label))}>
              <svg class="icon" viewBox="0 0 24 24" aria-hidden="true"><path d={icon} /></svg>
              <span>{label}</span>
            </button>
          );
        })}
      </div>
    </nav>
  );
}
