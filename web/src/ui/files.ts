// Files in and out of the page.
import { t } from "../i18n";
import { MOST_SCENE_BYTES } from "../scenes/library";

/** Saves bytes under a name, through the browser's downloads. */
export function download(name: string, content: BlobPart, type: string): void {
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  // The download has begun by then; the memory is given back.
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** A name for a file: letters, digits and dashes of any script. */
export function fileName(title: string, extension: string): string {
  const stem = title.toLowerCase().replaceAll(/[^\p{L}\p{N}]+/gu, "-").replaceAll(/^-|-$/g, "");
  return `${stem || "hyperbody"}.${extension}`;
}

/** The text of a file that may be a scene; rejects with words where it is too large for one. */
export async function sceneFile(file: File): Promise<string> {
  if (file.size > MOST_SCENE_BYTES) throw new Error(t().tooLarge(file.name, (MOST_SCENE_BYTES / 1e6).toFixed(0)));
  return file.text();
}

/** Lets the person choose a text file; null if they don't. Rejects as `sceneFile` does. */
export function chooseText(accept: string): Promise<string | null> {
  return new Promise((resolve, reject) => {
    const input = document.createElement("input");
    input.type = "file";
    input.accept = accept;
    input.onchange = () => void (input.files?.[0] ? sceneFile(input.files[0]).then(resolve, reject) : resolve(null));
    input.oncancel = () => resolve(null);
    input.click();
  });
}
