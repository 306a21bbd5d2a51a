// The icons: strokes on a 24 × 24 grid, so that they take the colour and weight of the text beside them.
const PATHS = {
  play: "M8 5.5v13l10.5-6.5z",
  pause: "M8.5 5.5v13M15.5 5.5v13",
  step: "M6 6v12l8-6zM18 6v12",
  slow: "M12 7v5l3 2M12 3.5a8.5 8.5 0 1 0 8.5 8.5M15.5 4.3l2 1.2M18.9 7.4l1 2",
  reset: "M5 12a7 7 0 1 0 2.2-5.1M5 4.5v4h4",
  undo: "M9 14L4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3",
  grid: "M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z",
  code: "M8 7l-5 5 5 5M16 7l5 5-5 5M13.5 5l-3 14",
  more: "M4 7h10M18 7h2M4 17h2M10 17h10M16 4.5v5M8 14.5v5",
  help: "M9.3 9.2a2.8 2.8 0 1 1 4.2 2.5c-1 .6-1.5 1.2-1.5 2.3M12 17.3v.2M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18",
  vr: "M4 8h16v9h-5l-2-2.5h-2L9 17H4zM8 11.8v.1M16 11.8v.1",
  tour: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18M15.5 8.5l-2 5-5 2 2-5z",
  home: "M4 11.5L12 5l8 6.5M6.5 10v9h11v-9",
  snap: "M5 19V5h14M5 12a7 7 0 0 1 7 7",
  follow: "M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8M12 2.5v3M12 18.5v3M2.5 12h3M18.5 12h3",
  freeze: "M12 3v18M4.2 7.5l15.6 9M19.8 7.5l-15.6 9M9.5 4.5L12 7l2.5-2.5M9.5 19.5L12 17l2.5 2.5",
  trash: "M5 7h14M10 7V4.5h4V7M7 7l.8 12.5h8.4L17 7M10.3 10.5v5.5M13.7 10.5v5.5",
  target: "M3 12h18M12 6a6 6 0 1 0 0 12 6 6 0 0 0 0-12",
  close: "M6 6l12 12M18 6L6 18",
  plus: "M12 5v14M5 12h14",
  chevron: "M6 9l6 6 6-6",
  full: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  camera: "M4 8h3.5l1.5-2.5h6L16.500 8H20v11H4zM12 10.500a3 3 0 1 0 0 6 3 3 0 0 0 0-6",
  record: "M12 7a5 5 0 1 0 0 10 5 5 0 0 0 0-10M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18",
  share: "M10 14a4 4 0 0 0 5.700 0l3-3a4 4 0 0 0-5.700-5.700l-1 1M14 10a4 4 0 0 0-5.700 0l-3 3a4 4 0 0 0 5.700 5.700l1-1",
  save: "M12 4v11M7.500 11l4.500 4.500 4.500-4.500M5 19.500h14",
} as const;

export type IconName = keyof typeof PATHS;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 24 24" aria-hidden="true">
      <path d={PATHS[name]} />
    </svg>
  );
}

interface ButtonProps {
  icon: IconName;
  label: string;
  onPress: () => void;
  pressed?: boolean;
  text?: boolean;
  disabled?: boolean;
  kind?: string;
}

/** What was clicked gives the keyboard back to the world: the next Space pauses. A press by key keeps its place. */
export function byHand(act: () => void): (event: MouseEvent) => void {
  return (event) => {
    const button = event.currentTarget as HTMLElement;
    if (event.detail > 0 && !button.closest("[role=dialog]")) button.blur();
    act();
  };
}

/** A button with an icon; its label is its tooltip and what screen readers say, and shown where `text` is set. */
export function IconButton({ icon, label, onPress, pressed, text, disabled, kind }: ButtonProps) {
  return (
    <button
      type="button" class={`button ${kind ?? ""}`} title={label} aria-label={label} aria-pressed={pressed} disabled={disabled} onClick={byHand(onPress)}
    >
      <Icon name={icon} />
      {text && <span>{label}</span>}
    </button>
  );
}
