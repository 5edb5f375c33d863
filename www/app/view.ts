// The viewport: a mesh, regions and a camera on a canvas.
//
// Drawing is done by the viewer's WebAssembly module, which loads when the first view is made. A frame
// is drawn when something has changed, never more than once for each frame of the display. A view that
// loses its WebGL context says so and comes back by itself when the browser returns the context.

import { CanvasView } from './canvas-view.js';
import type { Module } from './canvas-view.js';
import { messageOf, ViewError } from './view-types.js';
import type { View } from './view-types.js';

export * from './view-types.js';

let loading: Promise<Module> | undefined;

/**
 * Makes a view on a canvas that nothing else has drawn on.
 * @throws {ViewError} WebGL2 is missing, or the viewer cannot be loaded or started.
 */
export async function createView(canvas: HTMLCanvasElement): Promise<View> {
  if (!document.createElement('canvas').getContext('webgl2')) {
    throw new ViewError(
      'This browser offers no WebGL2, so meshes cannot be drawn. Meshing and export still work. ' +
        'Turning on hardware acceleration in the browser settings usually helps.',
    );
  }
  const module = await load();
  const view = new CanvasView(canvas, module);
  await view.start();
  return view;
}

/** The viewer's module, loaded once; a failed load is tried again by the next view. */
async function load(): Promise<Module> {
  loading ??= (async () => {
    const module = await import('../wasm/viewer/viewer.js');
    await module.default({ module_or_path: new URL('../wasm/viewer/viewer.wasm', import.meta.url) });
    return module;
  })();
  try {
    return await loading;
  } catch (cause) {
    loading = undefined;
    throw new ViewError(`The 3D viewer could not be loaded: ${messageOf(cause)}. Check the connection and reload.`);
  }
}
