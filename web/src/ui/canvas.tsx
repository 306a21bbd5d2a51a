// A small canvas that is drawn anew with every picture, sharp on every screen: for instruments that move all the time.
import { useEffect, useRef } from "preact/hooks";
import type { CanvasHTMLAttributes } from "preact";
import { usePlayground } from "./context";

export type Draw = (context: CanvasRenderingContext2D, width: number, height: number) => void;

interface LiveCanvasProps extends Omit<CanvasHTMLAttributes<HTMLCanvasElement>, "ref"> {
  draw: Draw;
}

export function LiveCanvas({ draw, ...rest }: LiveCanvasProps) {
  const playground = usePlayground();
  const canvas = useRef<HTMLCanvasElement>(null);
  const latest = useRef(draw);
  latest.current = draw;
  useEffect(() => {
    const paint = () => {
      const element = canvas.current;
      const context = element?.getContext("2d");
      if (!element || !context) return;
      const [width, height] = [element.clientWidth, element.clientHeight];
      const ratio = Math.min(3, window.devicePixelRatio || 1);
      const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
      if (element.width !== w) element.width = w;
      if (element.height !== h) element.height = h;
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, width, height);
      latest.current(context, width, height);
    };
    playground.onPicture.add(paint);
    return () => void playground.onPicture.delete(paint);
  }, [playground]);
  return <canvas ref={canvas} {...rest} />;
}
