// Hands the playground to the components without passing it through each.
import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { Playground } from "../app/playground";

const PlaygroundContext = createContext<Playground | null>(null);
export const PlaygroundProvider = PlaygroundContext.Provider;

export function usePlayground(): Playground {
  const playground = useContext(PlaygroundContext);
  if (!playground) throw new Error("a component was drawn outside of PlaygroundProvider");
  return playground;
}
