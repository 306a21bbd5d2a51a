// A part of the page's build: what there is goes into the worker that keeps the page for times without a net (public/sw.js).
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, relative, sep } from "node:path";

/** Writes the list of all files, and a version that changes with what they hold, into `sw.js`. */
export function offline() {
  let folder = "";
  return {
    name: "offline",
    apply: "build",
    configResolved: (config) => (folder = join(config.root, config.build.outDir)),
    closeBundle() {
      const worker = join(folder, "sw.js");
      const entries = readdirSync(folder, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile());
      const paths = entries.map((entry) => join(entry.parentPath, entry.name)).filter((path) => path !== worker).sort();
      const hash = createHash("sha256");
      for (const path of paths) hash.update(relative(folder, path)).update(readFileSync(path));
      const files = paths.map((path) => relative(folder, path).split(sep).join("/"));
      const code = readFileSync(worker, "utf8").replace("__VERSION__", hash.digest("hex").slice(0, 16)).replace("[/* __FILES__ */]", JSON.stringify(files));
      writeFileSync(worker, code);
    },
  };
}
