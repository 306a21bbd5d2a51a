// A part of the page's build: every text and the engine once more with brotli, as small as it gets, beside the file itself. `hyperbody
// play` sends these to browsers that take them, and so do web servers that are told to (nginx: brotli_static; Caddy: precompressed br).
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants } from "node:zlib";

const PACKED = /\.(html|js|css|wasm|svg|json)$/;
const PARAMETERS = { [constants.BROTLI_PARAM_QUALITY]: constants.BROTLI_MAX_QUALITY, [constants.BROTLI_PARAM_LGWIN]: constants.BROTLI_MAX_WINDOW_BITS };

/** Has to come after what changes files when all are there. */
export function packed() {
  let folder = "";
  return {
    name: "packed",
    apply: "build",
    configResolved: (config) => (folder = join(config.root, config.build.outDir)),
    closeBundle: {
      order: "post",
      sequential: true,
      handler() {
        const entries = readdirSync(folder, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile() && PACKED.test(entry.name));
        for (const entry of entries) {
          const path = join(entry.parentPath, entry.name);
          const plain = readFileSync(path);
          const bytes = brotliCompressSync(plain, { params: { ...PARAMETERS, [constants.BROTLI_PARAM_SIZE_HINT]: plain.length } });
          if (bytes.length < plain.length) writeFileSync(`${path}.br`, bytes);
        }
      },
    },
  };
}
