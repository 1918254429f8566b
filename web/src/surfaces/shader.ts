/** What light shows of a surface, worked out for every pixel from its normals and the eye. */

export const vertexShader = `
varying vec3 toEye;
varying vec3 normalSeen;
varying vec3 placeSeen;
attribute vec3 shade;
varying vec3 shadeSeen;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  toEye = -seen.xyz;
  placeSeen = position;
  normalSeen = normalMatrix * normal;
  shadeSeen = shade;
  gl_Position = projectionMatrix * seen;
}`;

/** look: 0 zebra, 1 isophotes, 2 reflection lines, 3 values, 4 plain. */
export const fragmentShader = `
uniform int look;
uniform float count;
varying vec3 toEye;
varying vec3 normalSeen;
varying vec3 placeSeen;
varying vec3 shadeSeen;
float bands(float value) {
  float width = max(fwidth(value), 1e-5);
  float at = fract(value);
  float up = smoothstep(0.0, width, at) - smoothstep(0.5, 0.5 + width, at);
  return mix(up, 0.5, clamp(2.0 * width - 0.6, 0.0, 1.0));
}
void main() {
  vec3 eye = normalize(toEye);
  vec3 n = normalize(normalSeen);
  if (dot(n, eye) < 0.0) n = -n;
  vec3 mirrored = reflect(-eye, n);
  float facing = dot(n, eye);
  vec3 metal = vec3(0.55, 0.58, 0.62) * (0.35 + 0.65 * facing);
  vec3 color = metal;
  if (look == 0) {
    float latitude = asin(clamp(mirrored.y, -1.0, 1.0));
    color = mix(vec3(0.05), vec3(0.96), bands(count * (0.5 + latitude / 3.14159265))) * (0.6 + 0.4 * facing);
  } else if (look == 1) {
    vec3 light = normalize(vec3(0.35, 0.6, 0.7));
    color = mix(vec3(0.16, 0.2, 0.26), vec3(0.93, 0.9, 0.82), bands(count * dot(n, light)));
  } else if (look == 2) {
    float along = mirrored.x / max(mirrored.z + 1.2, 0.05);
    float width = max(fwidth(count * along), 1e-4);
    float at = abs(fract(count * along) - 0.5);
    float lamp = 1.0 - smoothstep(0.06, 0.06 + width, at);
    color = metal * 0.55 + vec3(lamp * 0.95);
  } else if (look == 3) {
    color = shadeSeen * (0.55 + 0.45 * facing);
  } else {
    float gloss = pow(max(dot(mirrored, normalize(vec3(0.3, 0.8, 0.6))), 0.0), 24.0);
    color = metal + vec3(0.5 * gloss);
  }
  gl_FragColor = vec4(color, 1.0);
}`;
