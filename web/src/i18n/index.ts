// Which language the page speaks: the browser's choice at first, then the person's.
import { computed, effect } from "@preact/signals";
import { RefusedError } from "../engine/client";
import { kept, oneOf } from "../app/settings";
import { en, type Words } from "./en";
import { zh } from "./zh";

type Language = "en" | "zh";

const preferred: Language = navigator.languages.find((tag) => /^(en|zh)\b/i.test(tag))?.toLowerCase().startsWith("zh") ? "zh" : "en";

export const language = kept<Language>("language", preferred, oneOf("en", "zh"));

const words = computed<Words>(() => (language.value === "zh" ? zh : en));

/** The words of the current language; components that call it are drawn anew when it changes. */
export function t(): Words {
  return words.value;
}

/** What an error says, in the page's language where the page has words for it; the engine's own are English. */
export function wordsOf(error: unknown): string {
  const code = error instanceof RefusedError ? error.code : undefined;
  const known = code === undefined ? undefined : t().refused[code];
  return known ?? (error instanceof Error ? error.message : String(error));
}

effect(() => {
  document.documentElement.lang = language.value === "zh" ? "zh-CN" : "en";
});
