// The sheet of keys and gestures, drawn from the same table that the keyboard works by.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { KEY_GROUPS } from "../input/key-table";
import { t } from "../i18n";
import { Dialog } from "./dialog";

/** What the keys of a keyboard write, by their places, where the browser tells. */
const layout = signal<ReadonlyMap<string, string> | null>(null);

interface TellsLayout {
  keyboard?: { getLayoutMap(): Promise<ReadonlyMap<string, string>> };
}

/** Letters are meant by their place: on another layout they are called by what is written there. */
function asWritten(keys: string): string {
  return keys.replace(/(?<![A-Za-z])[A-Z](?![A-Za-z+])/g, (letter) => layout.value?.get(`Key${letter}`)?.toUpperCase() ?? letter);
}

export function Help() {
  useEffect(() => {
    // A browser that does not tell leaves the letters as they are.
    void (navigator as TellsLayout).keyboard?.getLayoutMap().then((map) => (layout.value = map), () => undefined);
  }, []);
  const words = t().keys;
  const gestures = [words.drag, words.wheelDrag, words.rightDrag, words.orbitMouse, words.wheelShift, words.touchOne, words.touchTwo, words.touchPinch, words.touchLong, words.vr];
  return (
    <Dialog title={t().help} kind="help">
      <div class="key-groups">
        {KEY_GROUPS.map(({ title, keys }) => (
          <section key={title}>
            <h3>{words[title]}</h3>
            <dl>
              {keys.map(({ shown, words: what }) => (
                <div key={what}><dt>{shown.map((key) => <kbd key={key}>{key === "Ctrl+Z" ? key : asWritten(key)}</kbd>)}</dt><dd>{words[what]}</dd></div>
              ))}
            </dl>
          </section>
        ))}
        <section>
          <h3>{words.groupHands}</h3>
          <ul>{gestures.map((gesture) => <li key={gesture}>{gesture}</li>)}</ul>
        </section>
      </div>
    </Dialog>
  );
}
