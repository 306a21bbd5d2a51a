// Keeps the page for times without a net, once it runs: public/sw.js does it. It asks the server first, so that a newer page is
// never hidden by an older one. While the page is worked on there is none.
import type { Playground } from "./playground";

export function keepForLater(playground: Playground): void {
  if (!import.meta.env.PROD || !("serviceWorker" in navigator)) return;
  const begin = () => {
    playground.onFrame.delete(begin);
    // Refused, as in private windows: then the page needs its server each time.
    navigator.serviceWorker.register("./sw.js", { updateViaCache: "none" }).catch(() => undefined);
  };
  playground.onFrame.add(begin);
}
