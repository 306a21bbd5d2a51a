// Titles and sentences of the built-in scenes in Chinese, by the scene's name.
export const zhScenes: Record<string, { title: string; sentence: string }> = {};
