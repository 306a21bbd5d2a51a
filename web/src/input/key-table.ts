// Which keys do what, as the sheet of shortcuts shows it. The keys themselves are handled in keyboard.ts: letters are those that
// are printed on the keys, on every keyboard.
import type { Words } from "../i18n/en";

type KeyWords = keyof Words["keys"];

interface KeyGroup {
  title: KeyWords;
  keys: { shown: string[]; words: KeyWords }[];
}

export const KEY_GROUPS: readonly KeyGroup[] = [
  {
    title: "groupSlice",
    keys: [
      { shown: ["E", "Q"], words: "forward" },
      { shown: ["Shift+E", "Shift+Q"], words: "next" },
      { shown: ["W"], words: "offKey" },
      { shown: ["R F", "T G", "Y H"], words: "turn" },
      { shown: ["Home", "0"], words: "homeKey" },
      { shown: ["9"], words: "snapKey" },
      { shown: ["L"], words: "followKey" },
    ],
  },
  {
    title: "groupTime",
    keys: [
      { shown: ["Space"], words: "pauseKey" },
      { shown: ["."], words: "stepKey" },
      { shown: [","], words: "slowKey" },
      { shown: ["[", "]"], words: "backKey" },
      { shown: ["Backspace"], words: "resetKey" },
      { shown: ["Ctrl+Z"], words: "undoKey" },
    ],
  },
  {
    title: "groupBody",
    keys: [
      { shown: ["N", "P"], words: "cycle" },
      { shown: ["J L", "I K", "U O"].map((keys) => `Alt+${keys}`), words: "carry" },
      { shown: ["Alt+E", "Alt+Q"], words: "carryOff" },
      { shown: ["Alt+←→↑↓"], words: "spinKey" },
      { shown: ["K"], words: "freezeKey" },
      { shown: ["Del"], words: "removeKey" },
      { shown: ["V"], words: "gravityKey" },
    ],
  },
  {
    title: "groupView",
    keys: [
      { shown: ["←→↑↓"], words: "orbitKey" },
      { shown: ["+", "−"], words: "zoomKey" },
      { shown: ["1"], words: "modeKey" },
      { shown: ["2"], words: "ghostKey" },
      { shown: ["3"], words: "wireKey" },
      { shown: ["4"], words: "jointKey" },
      { shown: ["A"], words: "frameKey" },
      { shown: ["M"], words: "fullKey" },
      { shown: ["C"], words: "galleryKey" },
      { shown: ["X"], words: "editorKey" },
      { shown: ["?"], words: "helpKey" },
      { shown: ["Esc"], words: "closeKey" },
    ],
  },
];
