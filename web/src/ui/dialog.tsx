// A sheet over the world: closes by Escape, by its cross, or by a press beside it; the keyboard starts inside it and stays
// there.
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { t } from "../i18n";
import { IconButton } from "./icons";
import { sheet } from "./state";

export function Dialog({ title, kind, children }: { title: string; kind: string; children: ComponentChildren }) {
  const panel = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const before = document.activeElement;
    panel.current?.focus();
    return () => void (before instanceof HTMLElement && before.focus());
  }, []);
  const close = () => (sheet.value = null);
  return (
    <div class={`backdrop ${kind}-backdrop`} onPointerDown={(event) => event.target === event.currentTarget && close()}>
      <div
        class={`dialog glass ${kind}`} role="dialog" aria-modal="true" aria-label={title} tabIndex={-1} ref={panel}
        onKeyDown={(event) => {
          if (event.key === "Tab") keepInside(event);
          if (event.key !== "Escape") return;
          event.stopPropagation();
          close();
        }}
      >
        <header><h2>{title}</h2><IconButton icon="close" label={t().close} onPress={close} /></header>
        {children}
      </div>
    </div>
  );
}

/** Tab goes round within the sheet: what lies under it is out of reach, as it is for the eye. */
function keepInside(event: KeyboardEvent & { currentTarget: HTMLElement }): void {
  const stops = [...event.currentTarget.querySelectorAll<HTMLElement>("button, input, textarea, a[href], [tabindex='0']")].filter(
    (element) => !element.matches(":disabled") && element.checkVisibility(),
  );
  const [first, last] = [stops[0], stops.at(-1)];
  const at = document.activeElement;
  if (!first || !last) return;
  if (event.shiftKey ? at === first || at === event.currentTarget : at === last) {
    event.preventDefault();
    (event.shiftKey ? last : first).focus();
  }
}
