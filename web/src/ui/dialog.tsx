// A sheet over the world: closes by Escape, by its cross, or by a press beside it; the keyboard starts inside it.
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
        class={`dialog glass ${kind}`} role="dialog" aria-label={title} tabIndex={-1} ref={panel}
        onKeyDown={(event) => {
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
