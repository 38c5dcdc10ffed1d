// SPDX-License-Identifier: Apache-2.0
// Colours of nodes, as linear red, green, blue.
import { Color } from 'three';

const LEVEL_STOPS = ['#4a6fd0', '#3f9ec4', '#55bd97', '#b4cf63', '#f2c455', '#ea8a43', '#cf4b45'];
const ERROR_STOPS = ['#5b7fa6', '#a9bfca', '#efe9d6', '#f0a868', '#d8543f', '#8f1d3a'];

function ramp(stops) {
  const colors = stops.map((stop) => new Color(stop));
  return (t, target) => {
    const place = Math.min(Math.max(t, 0), 1) * (colors.length - 1);
    const low = Math.min(Math.floor(place), colors.length - 2);
    return target.copy(colors[low]).lerp(colors[low + 1], place - low);
  };
}

export const levelRamp = ramp(LEVEL_STOPS);
export const errorRamp = ramp(ERROR_STOPS);
export const cssRamp = (stops) => `linear-gradient(90deg, ${stops.join(', ')})`;
export const errorGradient = cssRamp(ERROR_STOPS);

// Hues far apart for numbers that are near.
export function clusterColor(node, target) {
  const turn = (node * 0.618033988749895) % 1;
  const light = 0.42 + 0.16 * ((node * 0.7548776662466927) % 1);
  return target.setHSL(turn, 0.58, light);
}

// Fills `table` (three numbers a node) where nodes of the mesh stand. `scale`: the error that has the last colour.
export function colorNodes(mode, mesh, levelCount, scale, table) {
  const color = new Color();
  for (let v = 0; v < mesh.vertexCount; ++v) {
    if (mode === 'levels') levelRamp(mesh.levels[v] / Math.max(1, levelCount - 1), color);
    else if (mode === 'clusters') clusterColor(mesh.nodes[v], color);
    else errorRamp(scale > 0 ? mesh.errors[v] / scale : 0, color);
    color.toArray(table, 3 * mesh.nodes[v]);
  }
}
