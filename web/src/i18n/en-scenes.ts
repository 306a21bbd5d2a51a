// Titles of the engine's scenes in English; their sentences come with them.

/** What a language says of a scene; what is missing is taken from the scene. */
export interface SceneWords {
  title: string;
  sentence?: string;
}

const titles: Record<string, string> = {
  pyramid2d: "A wall of squares", bounce2d: "Six ways to bounce", cradle2d: "Newton's cradle", pyramid3d: "A pyramid of cubes", ramp3d: "Five cubes on a slope",
  wing_nut3d: "The wing nut", dominoes3d: "Thirty dominoes", seesaw3d: "Seesaw", gyroscope3d: "Gyroscope", car3d: "A car", door4d: "A door in 4D", wrecking_ball4d: "Wrecking ball on a rope",
  conveyor4d: "Two conveyors", mixer4d: "A mixer with gears", chain3d: "Chain and ball", stack4d: "Ten tesseracts high", pyramid4d: "A pyramid over a cube", pit4d: "The tesseract pit",
  dice4d: "Sixty dice", dice_pit4d: "A hundred round dice", balls4d: "Ball pit", capsules4d: "Logs", rounded4d: "Worn dice", ells4d: "Hooks", ramp4d: "Five tesseracts on a slope", tumble4d: "The 4D wing nut",
  bowling4d: "Bowling", pendulum4d: "Double pendulum", embedded4d: "3D inside 4D", stack5d: "A tower in 5D", clouds5d: "Two clouds in 5D", balls5d: "Ball pit in 5D", balls6d: "Ball pit in 6D",
};

export const enScenes: Record<string, SceneWords> = Object.fromEntries(Object.entries(titles).map(([name, title]) => [name, { title }]));
