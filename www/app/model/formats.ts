/** File formats by name and extension. */

import type { OutputFormat, InputFormat } from 'hexmill';
import type { CellKind } from './job.js';

export interface FormatInfo<F extends string> {
  readonly format: F;
  readonly extension: string;
  readonly label: string;
  /** What it is for, in a few words. */
  readonly note: string;
}

export const READABLE: readonly FormatInfo<InputFormat>[] = [
  { format: 'obj', extension: 'obj', label: 'Wavefront OBJ', note: '' },
  { format: 'stl', extension: 'stl', label: 'STL', note: '' },
  { format: 'vtu', extension: 'vtu', label: 'VTK XML', note: '' },
  { format: 'vtk', extension: 'vtk', label: 'Legacy VTK', note: '' },
  { format: 'medit', extension: 'mesh', label: 'MEDIT', note: '' },
  { format: 'msh', extension: 'msh', label: 'Gmsh', note: '' },
  { format: 'inp', extension: 'inp', label: 'Abaqus', note: '' },
];

export const WRITABLE: readonly FormatInfo<OutputFormat>[] = [
  { format: 'vtu', extension: 'vtu', label: 'ParaView', note: 'VTK XML, compressed, with levels, parents and tags' },
  { format: 'vtk', extension: 'vtk', label: 'legacy', note: 'Legacy VTK: ParaView, PyVista' },
  { format: 'msh', extension: 'msh', label: 'Gmsh', note: 'MSH 4.1: Gmsh, meshio, FEniCS' },
  { format: 'inp', extension: 'inp', label: 'Abaqus', note: 'Input deck of S4 shells: Abaqus, CalculiX' },
  { format: 'medit', extension: 'mesh', label: 'MEDIT', note: 'ASCII: MEDIT, libMeshb, FreeFem' },
  { format: 'obj', extension: 'obj', label: 'Wavefront', note: 'Blender and most modellers' },
  { format: 'glb', extension: 'glb', label: 'glTF', note: 'For viewing: quads become triangles' },
];

/** Formats that hold quads, linear hexes, or hexes of the second order. */
export function writable(cells: CellKind): readonly FormatInfo<OutputFormat>[] {
  if (cells === 'quads') return WRITABLE;
  const notes = cells === 'hexes' ? HEX_NOTES : SECOND_ORDER_NOTES;
  return WRITABLE.flatMap((info) => {
    const note = notes[info.format];
    return note === undefined ? [] : [{ ...info, note: note ?? info.note }];
  });
}

/** The formats that hold linear hexes, and what differs for these. GLB, which draws triangles, gets their boundary. */
const HEX_NOTES: Partial<Record<OutputFormat, string | null>> = {
  vtu: null,
  vtk: null,
  msh: null,
  inp: 'Input deck of C3D8 bricks: Abaqus, CalculiX',
  medit: null,
  glb: 'For viewing: the boundary alone',
};

/** The formats that hold hexes of the second order, and what differs for these. */
const SECOND_ORDER_NOTES: Partial<Record<OutputFormat, string | null>> = {
  vtu: null,
  vtk: null,
  msh: null,
  inp: 'Input deck of C3D20 or C3D27 bricks: Abaqus, CalculiX',
};

/** For the file dialog. */
export const ACCEPT = READABLE.map(({ extension }) => `.${extension}`).join(',');

/** `model.obj` as `model`. */
export function stem(name: string): string {
  return name.replace(/\.[^.]+$/, '');
}
