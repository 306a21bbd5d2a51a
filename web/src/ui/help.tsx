// The sheet of keys and gestures, drawn from the same table that the keyboard works by.
import { KEY_GROUPS } from "../input/key-table";
import { t } from "../i18n";
import { Dialog } from "./dialog";

export function Help() {
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
                <div key={what}><dt>{shown.map((key) => <kbd key={key}>{key}</kbd>)}</dt><dd>{words[what]}</dd></div>
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
