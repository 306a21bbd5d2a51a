// Scenes that a person keeps in this browser, and scenes that travel in a link: compressed into the address after the
// hash, which no server is ever sent.
import { signal } from "@preact/signals";

const KEY = "hyperbody.scenes";
const LINK = "#scene=";

/** No scene is larger, bytes: the engine's own limits on bodies and vertices end before. */
export const MOST_SCENE_BYTES = 8e6;

export interface KeptScene {
  name: string;
  text: string;
}

/** What `exportScenes` writes. */
const FORMAT = "hyperbody-scenes";

export const keptScenes = signal<KeptScene[]>(readKept());

// Other tabs of this address keep scenes too.
addEventListener("storage", (event) => {
  if (event.key === KEY || event.key === null) keptScenes.value = readKept();
});

function readKept(): KeptScene[] {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(KEY) ?? "[]");
    return Array.isArray(found) ? found.filter(isKept) : [];
  } catch {
    return [];
  }
}

function isKept(value: unknown): value is KeptScene {
  return typeof value === "object" && value !== null && "name" in value && "text" in value && typeof value.name === "string" && typeof value.text === "string";
}

/**
 * Keeps a scene under its own name; in place of the one called `replaces`, if there is one, and beside all others: a name that is
 * taken gets a number. Returns the name, or null where the browser does not let it.
 */
export function keepScene(text: string, replaces: string | null): string | null {
  // As it is now: another tab may have kept something since.
  const others = readKept().filter(({ name }) => name !== replaces);
  const name = freeName(nameIn(text), others);
  return store([{ name, text }, ...others]) ? name : null;
}

/** The scene that was forgotten last, until the page is left. */
export const forgottenScene = signal<KeptScene | null>(null);

export function forgetScene(name: string): void {
  const kept = readKept();
  const scene = kept.find((each) => each.name === name) ?? null;
  if (store(kept.filter((each) => each !== scene))) forgottenScene.value = scene;
}

/** Keeps what was forgotten last after all. */
export function rememberScene(): void {
  const scene = forgottenScene.value;
  const kept = readKept();
  if (scene && store([{ ...scene, name: freeName(scene.name, kept) }, ...kept])) forgottenScene.value = null;
}

/** All that is kept, as one file for another browser, address or machine. */
export function exportScenes(): string {
  return JSON.stringify({ format: FORMAT, version: 1, scenes: readKept() }, null, 1);
}

/** Whether a text is a file of `exportScenes`. */
export function isCollection(text: string): boolean {
  return collectionIn(text) !== null;
}

/** Keeps the scenes of a file of `exportScenes`, but for those that are here already. Says how many; null: no such file, or no room. */
export function importScenes(text: string): number | null {
  const found = collectionIn(text);
  if (!found) return null;
  const kept = readKept();
  let added = 0;
  for (const scene of found) {
    if (kept.some((each) => each.text === scene.text)) continue;
    kept.push({ name: freeName(scene.name, kept), text: scene.text });
    added += 1;
  }
  return store(kept) ? added : null;
}

function collectionIn(text: string): KeptScene[] | null {
  try {
    const file: unknown = JSON.parse(text);
    if (typeof file !== "object" || file === null || !("format" in file) || file.format !== FORMAT || !("scenes" in file)) return null;
    return Array.isArray(file.scenes) ? file.scenes.filter(isKept) : null;
  } catch {
    return null;
  }
}

function freeName(wanted: string, others: readonly KeptScene[]): string {
  const taken = new Set(others.map(({ name }) => name));
  let name = wanted;
  for (let number = 2; taken.has(name); number++) name = `${wanted} ${number}`;
  return name;
}

function store(scenes: KeptScene[]): boolean {
  try {
    localStorage.setItem(KEY, JSON.stringify(scenes));
  } catch {
    return false;
  }
  keptScenes.value = scenes;
  return true;
}

/** The name in a scene's text, or a stand-in where the text is not yet one. */
export function nameIn(text: string): string {
  try {
    const scene: unknown = JSON.parse(text);
    if (typeof scene === "object" && scene !== null && "name" in scene && typeof scene.name === "string" && scene.name) return scene.name;
  } catch {
    // Not JSON yet: the stand-in does.
  }
  return "scene";
}

/** The part of an address that carries a scene. */
export async function linkOf(text: string): Promise<string> {
  const packed = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  const characters = Array.from(packed, (byte) => String.fromCharCode(byte)).join("");
  return LINK + btoa(characters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The scene in an address; null where there is none. Rejects where it is damaged, or unpacks to more than any scene. */
export async function sceneInLink(hash: string): Promise<string | null> {
  if (!hash.startsWith(LINK)) return null;
  const characters = atob(hash.slice(LINK.length).replaceAll("-", "+").replaceAll("_", "/"));
  const packed = Uint8Array.from(characters, (character) => character.charCodeAt(0));
  return new TextDecoder().decode(await through(packed, new DecompressionStream("deflate-raw")));
}

/** What comes out of a stream, as far as it may be a scene: a short link can unpack to gigabytes. */
async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): Promise<Uint8Array<ArrayBuffer>> {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let size = 0;
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    parts.push(next.value);
    size += next.value.byteLength;
    if (size <= MOST_SCENE_BYTES) continue;
    await reader.cancel();
    throw new Error(`a scene of more than ${MOST_SCENE_BYTES} bytes`);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}
