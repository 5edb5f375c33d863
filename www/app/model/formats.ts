/** File formats by name and extension. */

import type { ExportFormat, InputFormat } from 'hexmill';

export interface FormatInfo<F extends string> {
  readonly format: F;
  readonly extension: string;
  readonly label: string;
  /** What it is for, in a few words. */
  readonly note: string;
}

export const READABLE: readonly FormatInfo<InputFormat>[] = [
  { format: 'obj', extension: 'obj', label: 'Wavefront OBJ', note: '' },
  { format: 'vtu', extension: 'vtu', label: 'VTK XML', note: '' },
  { format: 'vtk', extension: 'vtk', label: 'Legacy VTK', note: '' },
  { format: 'medit', extension: 'mesh', label: 'MEDIT', note: '' },
  { format: 'msh', extension: 'msh', label: 'Gmsh', note: '' },
  { format: 'inp', extension: 'inp', label: 'Abaqus', note: '' },
];

export const WRITABLE: readonly FormatInfo<ExportFormat>[] = [
  { format: 'vtu', extension: 'vtu', label: 'VTK XML', note: 'ParaView; compressed, with levels, parents and tags' },
  { format: 'vtk', extension: 'vtk', label: 'Legacy VTK', note: 'ParaView, PyVista' },
  { format: 'msh', extension: 'msh', label: 'Gmsh 4.1', note: 'Gmsh, meshio, FEniCS' },
  { format: 'inp', extension: 'inp', label: 'Abaqus', note: 'Abaqus, CalculiX; S4 shells' },
  { format: 'medit', extension: 'mesh', label: 'MEDIT', note: 'MEDIT, libMeshb, FreeFem' },
  { format: 'obj', extension: 'obj', label: 'Wavefront OBJ', note: 'Blender and most modellers' },
  { format: 'glb', extension: 'glb', label: 'Binary glTF', note: 'for viewing; quads as triangles' },
];

/** For the file dialog. */
export const ACCEPT = READABLE.map(({ extension }) => `.${extension}`).join(',');

/** The format of a file by its name; undefined when its extension is none of ours. */
export function formatOf(name: string): InputFormat | undefined {
  const extension = name.slice(name.lastIndexOf('.') + 1).toLowerCase();
  return READABLE.find((known) => known.extension === extension)?.format;
}

/** `model.obj` as `model`. */
export function stem(name: string): string {
  return name.replace(/\.[^.]+$/, '');
}
