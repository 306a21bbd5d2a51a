// Short words that come and go, and the menu of a body under the pointer.
import { useEffect } from "preact/hooks";
import { t } from "../i18n";
import { usePlayground } from "./context";
import { IconButton } from "./icons";
import { menu } from "./state";

const NOTICE_MS = 4200;
/** With a way back it stays long enough to be reached. */
const UNDO_MS = 9000;
const MENU_SIZE = { width: 230, height: 220 };

export function Notice() {
  const playground = usePlayground();
  const notice = playground.notice.value;
  useEffect(() => {
    if (!notice) return;
    const timer = setTimeout(() => (playground.notice.value = null), notice.undo ? UNDO_MS : NOTICE_MS);
    return () => clearTimeout(timer);
  }, [notice, playground]);
  return (
    <div class="notice-place" role="status" aria-live="polite">
      {notice && (
        <p class="notice glass">
          {notice.text}
          {notice.undo && <IconButton icon="undo" text label={t().undo} onPress={() => void playground.undo()} />}
        </p>
      )}
    </div>
  );
}

export function BodyMenu() {
  const playground = usePlayground();
  const open = menu.value;
  if (!open) return null;
  const { body } = open;
  const frozen = playground.readout.value?.selected?.frozen ?? false;
  const following = playground.followed.value === body;
  const choose = (action: () => void) => () => {
    menu.value = null;
    action();
  };
  const left = Math.max(8, Math.min(open.x, innerWidth - MENU_SIZE.width - 8));
  const top = Math.max(8, Math.min(open.y, innerHeight - MENU_SIZE.height - 8));
  return (
    <div class="menu glass" role="menu" style={{ left, top }}>
      <IconButton icon="target" text label={t().goThere} onPress={choose(() => playground.goTo(body))} />
      <IconButton icon="follow" text label={following ? t().unfollow : t().follow} onPress={choose(() => (playground.followed.value = following ? null : body))} />
      <IconButton icon="freeze" text label={frozen ? t().thaw : t().freeze} onPress={choose(() => playground.freeze(body, !frozen))} />
      <IconButton icon="trash" text label={t().remove} onPress={choose(() => void playground.remove(body))} />
    </div>
  );
}
