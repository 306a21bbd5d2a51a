// Pictures and films of the view, by the browser's own recorder.
import { signal } from "@preact/signals";

const FRAMES_PER_SECOND = 60;
const BITS_PER_SECOND = 12_000_000;
const FORMATS = ["video/mp4;codecs=avc1", "video/webm;codecs=vp9", "video/webm"];

export const recording = signal(false);
let recorder: MediaRecorder | null = null;

/** Starts a film, or ends it: then `done` gets it. Returns false where the browser has no recorder. */
export function toggleRecording(canvas: HTMLCanvasElement, done: (film: Blob, extension: string) => void): boolean {
  if (recorder) {
    recorder.stop();
    return true;
  }
  const format = typeof MediaRecorder === "undefined" ? undefined : FORMATS.find((type) => MediaRecorder.isTypeSupported(type));
  if (!format) return false;
  const parts: Blob[] = [];
  const started = new MediaRecorder(canvas.captureStream(FRAMES_PER_SECOND), { mimeType: format, videoBitsPerSecond: BITS_PER_SECOND });
  started.ondataavailable = (event) => parts.push(event.data);
  started.onstop = () => {
    recorder = null;
    recording.value = false;
    done(new Blob(parts, { type: format }), format.includes("mp4") ? "mp4" : "webm");
  };
  started.start(1000);
  recorder = started;
  recording.value = true;
  return true;
}
