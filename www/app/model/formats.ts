/** File formats by name and extension. */

import type { OutputFormat, InputFormat } from 'hexmill';

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

/** Formats that hold hexes, or quads. GLB, which draws triangles, gets the boundary of hexes. */
export function writable(hexes: boolean): readonly FormatInfo<OutputFormat>[] {
  return hexes ? WRITABLE.filter(({ format }) => format !== 'obj').map((info) => ({ ...info, note: HEX_NOTES[info.format] ?? info.note })) : WRITABLE;
}

/** What differs for hexes. */
const HEX_NOTES: Partial<Record<OutputFormat, string>> = {
  inp: 'Input deck of C3D8 bricks: Abaqus, CalculiX',
  glb: 'For viewing: the boundary alone',
};

/** For the file dialog. */
export const ACCEPT = READABLE.map(({ extension }) => `.${extension}`).join(',');

/** `model.obj` as `model`. */
export function stem(name: string): string {
  return name.replace(/\.[^.]+$/, '');
}
