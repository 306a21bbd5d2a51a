// The sky: a dome that goes from haze at the horizon to night above, so that depth and "up" are felt without drawing
// attention. The floor fades into the same haze.
import { BackSide, Color, Mesh, ShaderMaterial, SphereGeometry } from "three";

export const HAZE = new Color("#2f3857");
const ZENITH = new Color("#070a15");
const NADIR = new Color("#12172a");

/** Beyond everything, inside the camera's far plane. */
const RADIUS = 900;

export function makeSky(): Mesh {
  const material = new ShaderMaterial({
    uniforms: { haze: { value: HAZE }, zenith: { value: ZENITH }, nadir: { value: NADIR } },
    vertexShader: /* glsl */ `
      varying vec3 toward;
      void main() { toward = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: /* glsl */ `
      uniform vec3 haze, zenith, nadir;
      varying vec3 toward;
      // Dithering hides the bands that 8 bits make of a dark gradient.
      float noise(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
      void main() {
        float h = normalize(toward).y;
        vec3 colour = h > 0.0 ? mix(haze, zenith, 1.0 - exp(-h * 5.0)) : mix(haze, nadir, 1.0 - exp(h * 2.5));
        gl_FragColor = vec4(colour + (noise(gl_FragCoord.xy) - 0.5) / 255.0, 1.0);
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
      }`,
    side: BackSide,
    depthWrite: false,
  });
  const sky = new Mesh(new SphereGeometry(RADIUS, 32, 24), material);
  sky.frustumCulled = false;
  sky.renderOrder = -1;
  return sky;
}
