// The scene editor: text with line numbers, run with one press; what is wrong is named with its line while the running
// scene goes on. Keeps scenes in the browser and puts them into links.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { cameInLink } from "../app/address";
import type { Playground } from "../app/playground";
import { RefusedError } from "../engine/client";
import { t } from "../i18n";
import { importScenes, isCollection, keepScene, linkOf, nameIn } from "../scenes/library";
import { usePlayground } from "./context";
import { Dialog } from "./dialog";
import { chooseText, download, fileName } from "./files";
import { IconButton } from "./icons";
import { sheet } from "./state";

const text = signal("");
/** Whether a person has written in it since it was put there. */
let edited = false;
/** What was written when another text took its place. */
const aside = signal<string | null>(null);
/** Under which name what is edited is kept already: it is kept there again, and everything else beside it. */
const keptAs = signal<string | null>(null);
const problem = signal<{ message: string; line: number | undefined } | null>(null);
/** Counts what came into the editor: an answer that was asked for before the last of it comes too late. */
let arrivals = 0;

/** Puts a text into the editor; what somebody has written there is kept aside. */
function put(source: string): void {
  arrivals++;
  if (edited && text.value !== source && text.value.trim() !== "") aside.value = text.value;
  edited &&= text.value === source;
  text.value = source;
}

function bringBack(): void {
  const written = aside.value;
  if (written === null) return;
  aside.value = null;
  put(written);
  edited = true;
  keptAs.value = problem.value = null;
}

/** Runs a scene from outside; if it is broken, the editor opens on the line that is. A file of kept scenes is kept instead. */
export async function runText(playground: Playground, source: string, name: string | null = null): Promise<void> {
  if (source.trim() === "") {
    playground.say(t().emptyText);
    return;
  }
  if (isCollection(source)) {
    takeIn(playground, source);
    return;
  }
  if (source !== text.value || name !== null) keptAs.value = name;
  put(source);
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
  put(source);
  problem.value = { message: t().stopsEngine, line: undefined };
}

/** Keeps the scenes of a file that was exported here or elsewhere. */
export function takeIn(playground: Playground, source: string): void {
  const added = importScenes(source);
  playground.say(added === null ? t().noCollection : t().takenIn(added));
}

function keep(playground: Playground): void {
  const name = keepScene(text.value, keptAs.value);
  if (name !== null) keptAs.value = name;
  playground.say(name === null ? t().storageClosed : t().sceneSaved(name));
}

/** Puts the running scene's text into the editor, unless somebody writes or opens another before it arrives. */
async function takeCurrent(playground: Playground): Promise<void> {
  const asked = ++arrivals;
  const answer = await playground.client.request("sceneText", {});
  if (asked !== arrivals) return;
  put(answer.text);
  keptAs.value = null;
  problem.value = null;
}

/** Copies a link to the text. The page's own address becomes that link only where the text is what runs. */
async function share(playground: Playground): Promise<void> {
  const link = new URL(location.href);
  link.search = "";
  try {
    link.hash = await linkOf(text.value);
    if (text.value === playground.text) {
      history.replaceState(null, "", link.hash);
      cameInLink(text.value);
    }
  } catch {
    playground.say(t().linkTooLong); // Browsers take addresses of a megabyte or two.
    return;
  }
  try {
    await navigator.clipboard.writeText(link.href);
    playground.say(t().linkCopied);
  } catch {
    // The clipboard is closed to this page.
    history.replaceState(null, "", link.hash);
    cameInLink(text.value);
    playground.say(t().linkReady);
  }
}

function takeFile(found: string): void {
  put(found);
  keptAs.value = null;
}

function write(written: string): void {
  arrivals++;
  text.value = written;
  edited = true;
}

export function Editor() {
  const playground = usePlayground();
  const area = useRef<HTMLTextAreaElement>(null);
  const gutter = useRef<HTMLPreElement>(null);
  useEffect(() => {
    // What nobody has touched follows the running scene.
    const follows = !edited && problem.value === null && (text.value === "" || text.value !== playground.text);
    if (follows && playground.text !== null) text.value = playground.text;
    else if (follows) takeCurrent(playground).catch((error: Error) => playground.say(error.message));
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
          ref={area} spellcheck={false} aria-label={t().editor} value={text.value} data-testid="editor-text" onInput={(event) => write(event.currentTarget.value)}
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
          {t().problem(problem.value.message)}
        </p>
      )}
      {aside.value !== null && (
        <p class="row aside">
          <span>{t().keptAside}</span>
          <IconButton icon="undo" text label={t().bringBack} onPress={bringBack} />
        </p>
      )}
      <footer>
        <IconButton icon="play" kind="primary" text label={t().run} onPress={run} />
        <IconButton icon="undo" text label={t().current} onPress={() => void takeCurrent(playground)} />
        <IconButton icon="code" text label={t().open} onPress={() => void chooseText(".json,application/json").then((found) => found !== null && takeFile(found)).catch((error: Error) => playground.say(error.message))} />
        <IconButton icon="save" text label={t().download} onPress={() => download(fileName(nameIn(text.value), "json"), text.value, "application/json")} />
        <IconButton
          icon="plus" text label={t().keep} onPress={() => keep(playground)}
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
