// How the page is built: relative addresses, so that the export works from any folder of any web server, and modules in
// workers, so that the engine's worker shares the page's code.
import { defineConfig } from "vite";
import { offline } from "./tools/offline.mjs";
import { packed } from "./tools/packed.mjs";

export default defineConfig({
  base: "./",
  plugins: [offline(), packed()],
  build: { target: "es2022", assetsInlineLimit: 0, chunkSizeWarningLimit: 1200, modulePreload: { polyfill: false } },
  worker: { format: "es" },
  server: { host: "127.0.0.1" },
});
