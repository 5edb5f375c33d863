/** The models that ship with the page, with their licences. */

export interface Example {
  readonly id: string;
  readonly file: string;
  readonly label: string;
  /** Who made it. */
  readonly by: string;
  readonly licence: string;
  readonly source: string;
  readonly faces: string;
  readonly up: 'y' | 'z';
}

const OPENSUBDIV = {
  by: 'Pixar, OpenSubdiv regression shapes',
  licence: 'Modified Apache 2.0',
  source: 'https://github.com/PixarAnimationStudios/OpenSubdiv',
  up: 'z',
} as const;

export const EXAMPLES: readonly Example[] = [
  {
    id: 'spot', file: 'spot.obj', label: 'Spot', faces: '5,856 triangles',
    by: 'Keenan Crane', licence: 'CC0', source: 'https://www.cs.cmu.edu/~kmcrane/Projects/ModelRepository/', up: 'y',
  },
  { id: 'car', file: 'car.obj', label: 'Car', faces: '1,575 quads', ...OPENSUBDIV },
  { id: 'rook', file: 'rook.obj', label: 'Rook', faces: '777 quads and triangles', ...OPENSUBDIV },
  { id: 'bishop', file: 'bishop.obj', label: 'Bishop', faces: '968 quads and triangles', ...OPENSUBDIV },
  { id: 'pawn', file: 'pawn.obj', label: 'Pawn', faces: '588 quads', ...OPENSUBDIV },
  {
    id: 'bunny', file: 'bunny.obj', label: 'Bunny', faces: '6,966 triangles',
    by: 'Stanford Computer Graphics Laboratory', licence: 'Free with acknowledgement', source: 'https://graphics.stanford.edu/data/3Dscanrep/', up: 'y',
  },
  {
    id: 'plate', file: '3holes.obj', label: 'Plate', faces: '3,982 triangles',
    by: 'Marco Livesu, cinolib', licence: 'MIT', source: 'https://github.com/mlivesu/cinolib', up: 'z',
  },
  {
    id: 'milled', file: 'MFCAD_3-3-3-3-3-23.obj', label: 'Milled part', faces: '2,676 triangles',
    by: 'Weijuan Cao and others, MFCAD', licence: 'MIT', source: 'https://github.com/hducg/MFCAD', up: 'z',
  },
];

export function exampleById(id: string): Example | undefined {
  return EXAMPLES.find((example) => example.id === id);
}
