// The scene editor: text with line numbers, run with one press; what is wrong is named with its line while the running
// scene goes on. Keeps scenes in the browser and puts them into links.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { cameInLink } from "../app/address";
import type { Playground } from "../app/playground";
import { RefusedError } from "../engine/client";
import { t } from "../i18n";
import { keepScene, linkOf, nameIn } from "../scenes/library";
import { usePlayground } from "./context";
import { Dialog } from "./dialog";
import { chooseText, download, fileName } from "./files";
import { IconButton } from "./icons";
import { sheet } from "./state";

const text = signal("");
const problem = signal<{ message: string; line: number | undefined } | null>(null);

/** Runs a scene from outside; if it is broken, the editor opens on the line that is. */
export async function runText(playground: Playground, source: string): Promise<void> {
  text.value = source;
  try {
    await playground.loadText(source);
    problem.value = null;
  } catch (error) {
    problem.value = { message: error instanceof Error ? error.message : String(error), line: error instanceof RefusedError ? error.line : undefined };
    sheet.value = "editor";
  }
}

/** Puts a scene that keeps stopping the engine into the editor, with what is wrong. */
export function offerLost(source: string): void {
  text.value = source;
  problem.value = { message: t().stopsEngine, line: undefined };
}

async function takeCurrent(playground: Playground): Promise<void> {
  const answer = await playground.client.request("sceneText", {});
  text.value = answer.text;
  problem.value = null;
}

async function share(playground: Playground): Promise<void> {
  try {
    history.replaceState(null, "", await linkOf(text.value));
    cameInLink(text.value);
  } catch {
    playground.say(t().linkTooLong); // Browsers take addresses of a megabyte or two.
    return;
  }
  try {
    await navigator.clipboard.writeText(location.href);
    playground.say(t().linkCopied);
  } catch {
    playground.say(t().linkReady); // The clipboard is closed to this page.
  }
}

export function Editor() {
  const playground = usePlayground();
  const area = useRef<HTMLTextAreaElement>(null);
  const gutter = useRef<HTMLPreElement>(null);
  useEffect(() => {
    if (!text.value) takeCurrent(playground).catch((error: Error) => playground.say(error.message));
  }, [playground]);
  useEffect(() => {
    const line = problem.value?.line;
    if (line && area.current) showLine(area.current, line);
  }, [problem.value]);
  const lines = text.value.split("\n").length;
  const run = () => void runText(playground, text.value);
  return (
    <Dialog title={t().editor} kind="editor">
      <p class="hint">{t().editorHint}</p>
      <div class="code">
        <pre class="gutter" ref={gutter} aria-hidden="true">
          {Array.from({ length: lines }, (_, i) => <span key={i} class={problem.value?.line === i + 1 ? "bad" : ""}>{`${i + 1}\n`}</span>)}
        </pre>
        <textarea
          ref={area} spellcheck={false} aria-label={t().editor} value={text.value} data-testid="editor-text" onInput={(event) => (text.value = event.currentTarget.value)}
          onScroll={(event) => gutter.current && (gutter.current.scrollTop = event.currentTarget.scrollTop)}
          onKeyDown={(event) => {
            if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
            event.preventDefault();
            run();
          }}
        />
      </div>
      {problem.value && (
        <p class="problem" role="alert" data-testid="problem">
          {problem.value.line !== undefined && <b>{t().line(problem.value.line)}: </b>}
          {problem.value.message}
        </p>
      )}
      <footer>
        <IconButton icon="play" kind="primary" text label={t().run} onPress={run} />
        <IconButton icon="undo" text label={t().current} onPress={() => void takeCurrent(playground)} />
        <IconButton icon="code" text label={t().open} onPress={() => void chooseText(".json,application/json").then((found) => found && (text.value = found)).catch((error: Error) => playground.say(error.message))} />
        <IconButton icon="save" text label={t().download} onPress={() => download(fileName(nameIn(text.value), "json"), text.value, "application/json")} />
        <IconButton
          icon="plus" text label={t().keep}
          onPress={() => playground.say(keepScene({ name: nameIn(text.value), text: text.value }) ? t().sceneSaved(nameIn(text.value)) : t().storageClosed)}
        />
        <IconButton icon="share" text label={t().share} onPress={() => void share(playground)} />
      </footer>
    </Dialog>
  );
}

/** Selects a line, so that it is in view and the next key edits it. */
function showLine(area: HTMLTextAreaElement, line: number): void {
  const lines = area.value.split("\n");
  const start = lines.slice(0, line - 1).reduce((sum, each) => sum + each.length + 1, 0);
  area.focus();
  area.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
  area.scrollTop = Math.max(0, (line - 4) * (area.scrollHeight / lines.length));
}
