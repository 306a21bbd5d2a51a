// Scenes dropped onto the page as files, or pasted as text, run at once.
import type { Playground } from "../app/playground";
import { runText } from "./editor";
import { sceneFile } from "./files";

export function acceptScenes(playground: Playground): void {
  addEventListener("dragover", (event) => {
    if (event.dataTransfer?.types.includes("Files")) event.preventDefault();
  });
  addEventListener("drop", (event) => {
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    event.preventDefault();
    sceneFile(file).then((text) => runText(playground, text)).catch((error: Error) => playground.say(error.message));
  });
  addEventListener("paste", (event) => {
    if (event.target instanceof HTMLTextAreaElement || event.target instanceof HTMLInputElement) return;
    const text = event.clipboardData?.getData("text/plain").trim();
    if (text?.startsWith("{")) void runText(playground, text);
  });
}
