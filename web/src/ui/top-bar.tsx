// The top of the page: what one sees, and the ways to everything else.
import { t } from "../i18n";
import { usePlayground } from "./context";
import { sceneWords } from "./gallery";
import { byHand, IconButton } from "./icons";
import { sheet, toggleSheet, tourStep } from "./state";
import { xr } from "../input/xr/session";

export function TopBar() {
  const playground = usePlayground();
  const scene = playground.scene.value;
  const words = scene && sceneWords(playground.sceneName.value, scene);
  return (
    <header class="top">
      <div class="brand">
        <svg viewBox="0 0 64 64" aria-hidden="true"><path class="brand-warm" d="M10 22h30v30H10z" /><path class="brand-cool" d="M24 10h30v30H24z" /><path class="brand-link" d="M10 22l14-12M40 22l14-12M40 52l14-12M10 52l14-12" /></svg>
        <div>
          <h1>{words?.title ?? "Hyperbody"}{scene && <span class="badge">{t().dimensions(scene.dimension)}</span>}</h1>
          <p>{words?.sentence || t().tagline}</p>
        </div>
      </div>
      <nav class="glass top-actions" aria-label="Hyperbody">
        <IconButton icon="grid" text kind="accent" label={t().scenes} pressed={sheet.value === "gallery"} onPress={() => toggleSheet("gallery")} />
        <IconButton icon="tour" text label={t().tour} pressed={tourStep.value !== null} onPress={() => (tourStep.value = tourStep.value === null ? 0 : null)} />
        {scene?.dimension === 3 && (
          <button type="button" class="button" aria-pressed={playground.flatland.value} onClick={byHand(() => playground.setFlatland(!playground.flatland.value))}><span>{t().flatland}</span></button>
        )}
        <IconButton icon="code" kind="wide-only" label={t().editor} pressed={sheet.value === "editor"} onPress={() => toggleSheet("editor")} />
        {xr.supported.value && <IconButton icon="vr" label={t().enterVr} onPress={() => void xr.enter(playground)} />}
        <IconButton icon="more" label={t().more} pressed={sheet.value === "more"} onPress={() => toggleSheet("more")} />
        <IconButton icon="help" kind="wide-only" label={t().help} pressed={sheet.value === "help"} onPress={() => toggleSheet("help")} />
      </nav>
    </header>
  );
}
