// The gallery: every built-in scene with its picture, in groups, and the person's own.
import type { BuiltIn } from "../engine/protocol";
import { t } from "../i18n";
import { galleryGroups, pictureOf } from "../scenes/gallery";
import { exportScenes, forgetScene, forgottenScene, keptScenes, rememberScene } from "../scenes/library";
import { usePlayground } from "./context";
import { Dialog } from "./dialog";
import { takeIn, runText } from "./editor";
import { chooseText, download } from "./files";
import { IconButton } from "./icons";
import { sheet } from "./state";

/** Title and sentence in the page's language, as far as it has them; the scene's own are English. */
export function sceneWords(name: string | null, scene: { title: string; sentence: string }): { title: string; sentence: string } {
  const words = name === null ? undefined : t().scene[name];
  return { title: words?.title ?? scene.title, sentence: words?.sentence ?? scene.sentence };
}

export function Gallery() {
  const playground = usePlayground();
  const open = (name: string) => {
    sheet.value = null;
    void playground.open(name);
  };
  return (
    <Dialog title={t().scenes} kind="gallery">
      <div class="gallery-groups">
        {keptScenes.value.length > 0 && <OwnScenes />}
        {galleryGroups(playground.builtins.value).map(({ group, scenes }) => (
          <section key={group}>
            <h3>{t().group[group] ?? group}</h3>
            <ul>{scenes.map((scene) => <Card key={scene.name} scene={scene} onOpen={() => open(scene.name)} />)}</ul>
          </section>
        ))}
        {keptScenes.value.length === 0 && <section><h3>{t().mine}</h3><Taking /></section>}
      </div>
    </Dialog>
  );
}

function Card({ scene, onOpen }: { scene: BuiltIn; onOpen: () => void }) {
  const { title, sentence } = sceneWords(scene.name, scene);
  return (
    <li>
      <button type="button" class="card" data-scene={scene.name} onClick={onOpen}>
        <img src={pictureOf(scene.name)} alt="" loading="lazy" width={320} height={200} onError={(event) => event.currentTarget.classList.add("missing")} />
        <span class="badge">{t().dimensions(scene.dimension)}</span>
        <strong>{title}</strong>
        <small>{sentence}</small>
      </button>
    </li>
  );
}

function OwnScenes() {
  const playground = usePlayground();
  return (
    <section>
      <h3>{t().mine}</h3>
      <ul>
        {keptScenes.value.map(({ name, text }) => (
          <li key={name} class="own">
            <button
              type="button" class="card"
              onClick={() => {
                sheet.value = null;
                void runText(playground, text, name);
              }}
            >
              <strong>{name}</strong>
            </button>
            <IconButton icon="trash" label={t().remove} onPress={() => forgetScene(name)} />
          </li>
        ))}
      </ul>
      <Taking />
    </section>
  );
}

/** What is kept here is kept for this address alone: ways to take it along. */
function Taking() {
  const playground = usePlayground();
  const take = () => void chooseText(".json,application/json").then((found) => found !== null && takeIn(playground, found)).catch((error: Error) => playground.say(error.message));
  return (
    <>
      {forgottenScene.value && (
        <p class="row">
          <span>{t().forgotten(forgottenScene.value.name)}</span>
          <IconButton icon="undo" text label={t().undo} onPress={rememberScene} />
        </p>
      )}
      <p class="hint">{t().keptHere(location.host)}</p>
      <div class="row">
        {keptScenes.value.length > 0 && <IconButton icon="save" text label={t().exportAll} onPress={() => download("hyperbody-scenes.json", exportScenes(), "application/json")} />}
        <IconButton icon="plus" text label={t().importAll} onPress={take} />
      </div>
    </>
  );
}
