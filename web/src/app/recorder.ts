// Pictures and films of the view, by the browser's own recorder.
import { signal } from "@preact/signals";

const FRAMES_PER_SECOND = 60;
const BITS_PER_SECOND = 12_000_000;
/** A film ends by itself after so long, or so many bytes: it is kept in memory until then. */
const LONGEST_MS = 5 * 60_000;
const MOST_BYTES = 400e6;
const FORMATS = ["video/mp4;codecs=avc1", "video/webm;codecs=vp9", "video/webm"];

export const recording = signal(false);
let recorder: MediaRecorder | null = null;

/**
 * Starts a film, or ends it: then `done` gets it. It ends by itself when it is long or large. Returns false where the browser
 * has no recorder, or refuses to start it.
 */
export function toggleRecording(canvas: HTMLCanvasElement, done: (film: Blob, extension: string) => void): boolean {
  if (recorder) {
    recorder.stop();
    return true;
  }
  const format = typeof MediaRecorder === "undefined" ? undefined : FORMATS.find((type) => MediaRecorder.isTypeSupported(type));
  if (!format) return false;
  const parts: Blob[] = [];
  let started: MediaRecorder;
  try {
    started = new MediaRecorder(canvas.captureStream(FRAMES_PER_SECOND), { mimeType: format, videoBitsPerSecond: BITS_PER_SECOND });
    started.start(1000);
  } catch {
    return false;
  }
  let size = 0;
  const limit = setTimeout(() => started.state !== "inactive" && started.stop(), LONGEST_MS);
  started.ondataavailable = (event) => {
    parts.push(event.data);
    size += event.data.size;
    if (size > MOST_BYTES && started.state !== "inactive") started.stop();
  };
  started.onstop = () => {
    clearTimeout(limit);
    for (const track of started.stream.getTracks()) track.stop();
    recorder = null;
    recording.value = false;
    done(new Blob(parts, { type: format }), format.includes("mp4") ? "mp4" : "webm");
  };
  recorder = started;
  recording.value = true;
  return true;
}
