// Takes the gallery's pictures from the built page, one of every scene, into public/gallery: `npm run build`, then
// `node tools/pictures.mjs [scene…]`, then build again. Looked at by a person before they are committed. They are AVIF, which all
// browsers that run the engine know, at half the size of WebP: `avifenc` makes them (Debian's package libavif-bin).
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { launch, open, serve } from "../tests/support.mjs";

const OUT = new URL("../public/gallery/", import.meta.url);
const VIEW = { width: 960, height: 600 };
/** What the panels leave free: that is where the camera puts the scene. Flatland fills the page. */
const FREE = { x: 72, y: 74, width: 704, height: 440 };
const PICTURE = { width: 320, height: 200 };
/** Of avifenc, 0 (lossless) to 63. */
const QUANTIZER = "46";
/** When a scene shows what it is about, s of its time. */
const USUAL_MOMENT = 1.6;
const MOMENTS = {
  hello4d: 1.3, smash4d: 0.5, dominoes_w4d: 1.2, regular_dice4d: 0.9, dominoes3d: 2.6, bowling4d: 0.3, pit4d: 2.5, dice4d: 2.2, balls4d: 1.6, capsules4d: 2, toybox4d: 2.4, chain3d: 0.5, pendulum4d: 0.6,
  seesaw3d: 0.75, gyroscope3d: 1, car3d: 0.5, door4d: 1.1, wrecking_ball4d: 1.75, conveyor4d: 2.5, mixer4d: 2,
  bounce2d: 0.95, cradle2d: 0.5, clouds5d: 1.2, wing_nut3d: 1, net4d: 0.35, ramp4d: 0.3, ramp3d: 0.6, rolling4d: 0.6,
};

/** Moments before this are caught in very slow motion, s, the others in slow motion: a page that draws in software sees few. */
const EARLY = 1;
const SLOW = { early: 0.1, later: 0.35 };

const folder = mkdtempSync(join(tmpdir(), "hyperbody-pictures-"));
const plain = join(folder, "plain.png");
const wanted = process.argv.slice(2);
mkdirSync(OUT, { recursive: true });
const [browser, server] = await Promise.all([launch(), serve()]);
const context = await browser.newContext({ viewport: VIEW, locale: "en-GB" });
const { page } = await open(context, server.address);
await page.keyboard.press("c");
const names = await page.locator("[data-scene]").evaluateAll((cards) => cards.map((card) => card.dataset.scene));
await page.close();
for (const name of wanted.length > 0 ? wanted : names) {
  const moment = MOMENTS[name] ?? USUAL_MOMENT;
  const { page: each, errors } = await open(context, server.address, { scene: name, query: `&detail=1&speed=${moment < EARLY ? SLOW.early : SLOW.later}` });
  await each.addStyleTag({ content: "#app > :not(.flatland) { display: none !important } .flatland { left: 20px !important; top: 20px !important; bottom: 20px !important; width: 46vw !important }" });
  await each.waitForFunction((wantedTime) => window.hyperbody.frame.time >= wantedTime, moment, { timeout: 60_000 });
  await each.keyboard.press("Space");
  await each.waitForTimeout(500);
  const shot = (await each.screenshot({ type: "png", ...(name.startsWith("flatland") ? {} : { clip: FREE }) })).toString("base64");
  const png = await each.evaluate(async ({ data, width, height }) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    const context2d = canvas.getContext("2d");
    context2d.imageSmoothingQuality = "high";
    context2d.drawImage(image, 0, 0, width, height);
    return canvas.toDataURL("image/png").split(",")[1];
  }, { data: shot, ...PICTURE });
  writeFileSync(plain, Buffer.from(png, "base64"));
  const packed = fileURLToPath(new URL(`${name}.avif`, OUT));
  execFileSync("avifenc", ["-s", "2", "-y", "420", "--min", QUANTIZER, "--max", QUANTIZER, plain, packed], { stdio: "pipe" });
  console.log(name, errors.length ? errors : "");
  await each.close();
}
await browser.close();
server.close();
rmSync(folder, { recursive: true });
