//! Files that lie about their sizes, one table a reader: each is refused with its code and with words that say what is
//! wrong and where, and none takes more memory than a file of its size is worth.

use hexmill::io::{Format, read};
use miniz_oxide::deflate::compress_to_vec_zlib;

use super::allocation::most_held;

/// What a reader may hold beside [`PER_BYTE`] for each byte of the file.
const ALWAYS: usize = 4 << 20;
const PER_BYTE: usize = 1000;

/// Checks that `bytes` are refused with `code`, by a message with these `words` in it, and without much memory.
#[track_caller]
fn check(format: Format, bytes: &[u8], code: &str, words: &str) {
    let (result, held) = most_held(|| read(bytes, format));
    let error = result.expect_err(words);
    assert_eq!(error.code, code, "{error}");
    assert!(error.to_string().contains(words), "{error}");
    assert!(held <= ALWAYS + PER_BYTE * bytes.len(), "{held} bytes for {}: {error}", bytes.len());
}

/// Bytes that are no file of any format.
const GARBAGE: &[u8] = b"\x9C\x12\xFF\n\x07\0\0\x80\x81\xC3\x28";

#[test]
fn obj() {
    let check = |text: &str, code, words| check(Format::Obj, text.as_bytes(), code, words);
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    check(&format!("{triangle}t crease 4000000000/1/0 0 1 2\n"), "obj-bad-tag", "line 4: ");
    check(&format!("{triangle}f 1 2"), "obj-face-too-short", "line 4: face has 2 nodes");
    check("v 0 0 nan\n", "obj-not-finite", "line 1: ");
    check(&format!("{triangle}f 1 2 -4\n"), "obj-index-out-of-range", "line 4: ");
    check(&format!("{triangle}f 1 2 4000000000\n"), "obj-index-out-of-range", "vertex 4000000000 is used");
    super::hostile::check(Format::Obj, GARBAGE, "obj-unknown-statement", "line 1: ");
    super::hostile::check(Format::Obj, b"\0v\0 \x000\0 \x000", "obj-wide-text", "UTF-16");
}

#[test]
fn medit() {
    let head = "MeshVersionFormatted 2\nDimension 3\n";
    let nodes = format!("{head}Vertices\n3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n");
    for (text, code, words) in [
        (format!("{head}Vertices\n4000000000\n0 0 0 0\n"), "truncated", "line 4: the number of vertices"),
        (format!("{nodes}Quadrilaterals\n99999999\n1 2"), "truncated", "line 9: the number of cells"),
        (format!("{nodes}Triangles\n1\n1 2"), "truncated", "line 10: "),
        (format!("{nodes}Ridges\n4000000000\n1\n"), "truncated", "line 9: the number of entries"),
        (format!("{head}Vertices\n-3\n"), "bad-number", "it cannot be negative"),
        (
            format!("{}Triangles\n1\n1 2 3 0\n", nodes.replace("1 0 0 0", "1 nan 0 0")),
            "coordinate-not-finite",
            "node 2",
        ),
        (
            format!("{nodes}Triangles\n1\n1 2 -3 0\n"),
            "node-out-of-range",
            "line 10: cell 0 (counted from 0) names node -3",
        ),
        (
            format!("{nodes}Triangles\n1\n1 2 9223372036854775807 0\n"),
            "node-out-of-range",
            "node 9223372036854775807",
        ),
        (format!("{nodes}Triangles\n1\n1 2 3 0\nCorners\n1\n4\n"), "node-out-of-range", "a corner is node 4"),
    ] {
        check(Format::Medit, text.as_bytes(), code, words);
    }
    check(Format::Medit, GARBAGE, "not-this-format", "line 1: ");
    check(Format::Medit, b"\0\0\0\x01\0\0\0\x02", "unsupported-encoding", "binary MEDIT file");
}

#[test]
fn vtk() {
    let head = |kind: &str| format!("# vtk DataFile Version 3.0\nt\n{kind}\nDATASET UNSTRUCTURED_GRID\n");
    let grid = format!("{}POINTS 3 float\n0 0 0 1 0 0 0 1 0\n", head("ASCII"));
    let cell = |nodes: &str| format!("{grid}CELLS 1 4\n{nodes}\nCELL_TYPES 1\n5\n");
    for (text, code, words) in [
        (format!("{}POINTS 9223372036854775807 double\n0", head("ASCII")), "truncated", "the points are"),
        (
            format!("{grid}CELLS 1 4000000000\n3 0 1 2\n"),
            "truncated",
            "line 8: the cells are 4000000000 words",
        ),
        (format!("{grid}CELL_TYPES 99999999\n5\n"), "truncated", "line 7: the cell types"),
        (
            format!("{}CELL_DATA 99999999\nSCALARS a int\nLOOKUP_TABLE d\n0\n", cell("3 0 1 2")),
            "truncated",
            "line 14",
        ),
        (format!("{grid}FIELD f 1\na 4294967296 4294967296 int\n0\n"), "truncated", "an attribute are"),
        (format!("{grid}POINT_DATA 3\nLOOKUP_TABLE t 9223372036854775807\n0\n"), "truncated", "colours are"),
        (format!("{grid}CELLS 1 4\n3 0 1"), "truncated", "line 8: "),
        (format!("{grid}CELLS -1 4\n"), "bad-number", "it cannot be negative"),
        (cell("-3 0 1 2"), "inconsistent", "cell 0 (counted from 0) has -3 nodes"),
        (cell("3 0 1 -1"), "node-out-of-range", "cell 0 (counted from 0) names node -1"),
        (cell("3 0 1 4000000000"), "node-out-of-range", "node 4000000000"),
        (cell("3 0 1 2").replace("1 0 0", "1 0 nan"), "coordinate-not-finite", "node 1 has a coordinate"),
        (
            format!(
                "{grid}CELLS 2 3\nOFFSETS vtktypeint64\n0 99\nCONNECTIVITY vtktypeint64\n0 1 2\nCELL_TYPES 1\n5\n"
            ),
            "inconsistent",
            "the nodes 0 to 99 of 3",
        ),
        (
            format!(
                "{grid}CELLS 2 3\nOFFSETS vtktypeint64\n0 -1\nCONNECTIVITY vtktypeint64\n0 1 2\nCELL_TYPES 1\n5\n"
            ),
            "inconsistent",
            "its offset is wrong",
        ),
    ] {
        check(Format::Vtk, text.as_bytes(), code, words);
    }
    check(Format::Vtk, GARBAGE, "not-this-format", "line 1: ");
    // Numbers in the wrong order of bytes: the count of nodes of the first cell becomes 50331648.
    let points = [0.0_f32, 0., 0., 1., 0., 0., 0., 1., 0.].map(f32::to_be_bytes).concat();
    let binary = |cells: &[i32], bytes: fn(i32) -> [u8; 4]| {
        let cells: Vec<u8> = cells.iter().flat_map(|&n| bytes(n)).collect();
        [head("BINARY").as_bytes(), b"POINTS 3 float\n", &points, b"\nCELLS 1 4\n", &cells].concat()
    };
    check(
        Format::Vtk,
        &binary(&[3, 0, 1, 2], i32::to_le_bytes),
        "inconsistent",
        "cell 0 (counted from 0) has 50331648 nodes",
    );
    check(Format::Vtk, &binary(&[3, 0, 1], i32::to_be_bytes), "truncated", "the cells should take 16 bytes");
    let claim = [head("BINARY").as_bytes(), b"POINTS 9223372036854775807 double\n", &points].concat();
    check(Format::Vtk, &claim, "truncated", "but 36 are left");
}

#[test]
fn msh() {
    let head = |version: &str| format!("$MeshFormat\n{version}\n$EndMeshFormat\n");
    let nodes = format!("{}$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n", head("2.2 0 8"));
    let element = |words: &str| format!("{nodes}$Elements\n1\n{words}\n$EndElements\n");
    let four = head("4.1 0 8");
    for (text, code, words) in [
        (
            format!("{}$Nodes\n4000000000\n1 0 0 0\n", head("2.2 0 8")),
            "truncated",
            "line 5: the number of nodes",
        ),
        (format!("{nodes}$Elements\n99999999\n1 2"), "truncated", "line 11: the number of elements"),
        (element("1 2 99999999 0 0 1 2 3"), "bad-number", "'$EndElements' stands where a tag"),
        (
            format!("{four}$Nodes\n1 3 1 3\n2 1 0 9223372036854775807\n1\n"),
            "truncated",
            "line 6: the number of nodes of a block",
        ),
        (format!("{four}$Nodes\n9223372036854775807 3 1 3\n2 1 0 0\n"), "truncated", "cut short"),
        (format!("{four}$Nodes\n1 3 1 3\n2 1 0 -1\n"), "truncated", "of a block is -1"),
        (
            format!("{four}$Elements\n1 1 1 1\n2 1 2 4000000000\n1 1 2 3\n"),
            "truncated",
            "elements of a block",
        ),
        (format!("{four}$Entities\n1 0 0 0\n1 0 0 0 4000000000 1\n"), "truncated", "groups of an entity"),
        (
            format!("{four}$PhysicalNames\n4000000000\n2 1 \"a\"\n"),
            "truncated",
            "line 5: the number of names",
        ),
        (element("1 2 2 0 0 1 2 -3"), "node-out-of-range", "element 1 names node -3"),
        (element("1 2 2 0 0 1 2 4000000000"), "node-out-of-range", "node 4000000000"),
        (element("1 2 2 0 0 1 2 3").replace("2 1 0 0", "2 inf 0 0"), "coordinate-not-finite", "node 2"),
        (nodes[..nodes.len() - 10].to_owned(), "truncated", "where $EndNodes should stand"),
    ] {
        check(Format::Msh, text.as_bytes(), code, words);
    }
    check(Format::Msh, GARBAGE, "not-this-format", "line 1: ");
    let binary = |one: i32, numbers: &[u64]| {
        let numbers: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        let start = [b"$MeshFormat\n4.1 1 8\n".as_slice(), &one.to_le_bytes(), b"\n$EndMeshFormat\n$Nodes\n"];
        [start.concat(), numbers].concat()
    };
    // Little-endian data that are said to be big-endian: one block becomes 2^56 of them.
    check(Format::Msh, &binary(1 << 24, &[1, 3, 1, 3]), "truncated", "should take 4 bytes");
    check(Format::Msh, &binary(7, &[]), "syntax", "the byte order is not told by the number 1");
    let block = binary(1, &[1, 3, 1, 3, 2 | 1 << 32, 0]);
    check(Format::Msh, &[&block[..block.len() - 4], &[0xFF; 8]].concat(), "truncated", "of a block is -1");
}

#[test]
fn msh_names_that_multiply() {
    // Each entity is in all groups, in an order of its own, and each group has a long name.
    let name = "long".repeat(5_000);
    let names: String = (1..=6).map(|group| format!("2 {group} \"{name}{group}\"\n")).collect();
    let orders: Vec<String> = (0..720_usize)
        .map(|k| {
            let (mut left, mut k) = ((1..=6).collect::<Vec<u8>>(), k);
            (1..=6).rev().map(|n| (left.remove(k % n), k /= n).0.to_string() + " ").collect()
        })
        .collect();
    let entities: String =
        (1..).zip(&orders).map(|(n, groups)| format!("{n} 0 0 0 0 0 0 6 {groups} 0\n")).collect();
    let blocks: String = (1..=720).map(|n| format!("2 {n} 2 0\n")).collect();
    let text = format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n{names}$EndPhysicalNames\n$Entities\n0 0 720 0\n{entities}\
         $EndEntities\n$Elements\n720 0 0 0\n{blocks}$EndElements\n"
    );
    check(Format::Msh, text.as_bytes(), "too-large", "the names of groups");
    // One entity that is in a long-named group again and again is in it once.
    let again = format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"{name}\"\n$EndPhysicalNames\n$Entities\n0 0 1 0\n\
         1 0 0 0 0 0 0 50000 {}0\n$EndEntities\n$Elements\n1 0 0 0\n2 1 2 0\n$EndElements\n",
        "1 ".repeat(50_000)
    );
    check(Format::Msh, again.as_bytes(), "no-cells", "neither faces");
}

#[test]
fn inp() {
    let nodes = "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n";
    let element = format!("{nodes}*ELEMENT, TYPE=S3\n1, 1, 2, 3\n");
    for (text, code, words) in [
        (format!("{nodes}*ELEMENT, TYPE=S3\n1, 1, 2"), "cell-size", "line 6: element 1 has 2 nodes"),
        (
            format!("{nodes}*ELEMENT, TYPE=S3\n1, 1, 2, -3\n"),
            "node-out-of-range",
            "line 6: element 1 names node -3",
        ),
        (format!("{nodes}*ELEMENT, TYPE=S3\n1, 1, 2, 4000000000\n"), "node-out-of-range", "node 4000000000"),
        (element.replace("2, 1, 0", "2, nan, 0"), "coordinate-not-finite", "line 3: node 2"),
        (format!("{element}*ELSET, ELSET=A, GENERATE\n1, 99999999999999999999\n"), "bad-number", "line 8: "),
        (
            format!("{element}*ELSET, ELSET=A, GENERATE\n-9223372036854775808, 9223372036854775807, -1\n"),
            "syntax",
            "line 8: GENERATE",
        ),
    ] {
        check(Format::Inp, text.as_bytes(), code, words);
    }
    check(Format::Inp, GARBAGE, "not-this-format", "line 1: ");
}

/// A part in `PART`, and 60 000 instances of it.
fn placed(part: &str) -> String {
    let mut text = format!("*PART, NAME=P\n{part}*END PART\n");
    for instance in 0..60_000 {
        text += &format!("*INSTANCE, NAME={instance}, PART=P\n*END INSTANCE\n");
    }
    text
}

#[test]
fn inp_instances_that_multiply() {
    let nodes: String = (1..=3_000).map(|n| format!("{n}, 0, 0\n")).collect();
    let element = "*ELEMENT, TYPE=S3\n1, 1, 2, 3\n";
    check(
        Format::Inp,
        placed(&format!("*NODE\n{nodes}{element}")).as_bytes(),
        "too-large",
        "180000000 nodes together",
    );
    let elements: String = (1..=3_000).map(|n| format!("{n}, 1, 2, 3\n")).collect();
    let few = "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n";
    let part = format!("{few}*ELEMENT, TYPE=S3\n{elements}");
    check(
        Format::Inp,
        placed(&part).as_bytes(),
        "too-large",
        "nodes of elements and members of sets together",
    );
    let sets: String = (0..9_000).map(|set| format!("*ELSET, ELSET=S{set}\n1\n")).collect();
    let part = format!("{few}{element}{sets}");
    check(Format::Inp, placed(&part).as_bytes(), "too-large", "members of sets together");
}

#[test]
fn inp_names_that_multiply() {
    let mut text = String::from("*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=S3\n");
    for element in 0..4096 {
        text += &format!("{element}, 1, 2, 3\n");
    }
    for bit in 0..12 {
        text += &format!("*ELSET, ELSET={}{bit}\n", "long".repeat(5_000));
        for element in (0..4096).filter(|element| element >> bit & 1 == 1) {
            text += &format!("{element}\n");
        }
    }
    check(Format::Inp, text.as_bytes(), "too-large", "the names of groups");
}

/// A VTU file of `pieces` with this appended data, raw.
fn vtu_file(attributes: &str, pieces: &str, appended: &[u8]) -> Vec<u8> {
    let start = format!(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" {attributes}>\
         <UnstructuredGrid>\n{pieces}</UnstructuredGrid><AppendedData encoding=\"raw\">_"
    );
    [start.as_bytes(), appended, b"</AppendedData></VTKFile>"].concat()
}

/// Three nodes and one cell, with the arrays `points`, `connectivity`, `offsets` and `types` at these places.
fn vtu_piece(nodes: u64, cells: u64, at: [usize; 4]) -> String {
    let array = |name: &str, kind: &str, size: usize, at: usize| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{size}\" format=\"appended\" offset=\"{at}\"/>\n"
        )
    };
    format!(
        "<Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{cells}\"><Points>\n{}</Points><Cells>\n{}{}{}</Cells></Piece>",
        array("points", "Float32", 3, at[0]),
        array("connectivity", "Int32", 1, at[1]),
        array("offsets", "Int32", 1, at[2]),
        array("types", "UInt8", 1, at[3]),
    )
}

/// Data after their size.
fn sized(data: &[u8]) -> Vec<u8> {
    [&(data.len() as u64).to_le_bytes(), data].concat()
}

/// The appended data of one triangle and where its arrays begin.
fn triangle(order: fn(i32) -> [u8; 4]) -> (Vec<u8>, [usize; 4]) {
    let points = [0.0_f32, 0., 0., 1., 0., 0., 0., 1., 0.].map(f32::to_le_bytes).concat();
    let arrays =
        [points, [0, 1, 2].map(order).concat(), [3].map(order).concat(), vec![5]].map(|data| sized(&data));
    let mut at = [0; 4];
    for k in 1..4 {
        at[k] = at[k - 1] + arrays[k - 1].len();
    }
    (arrays.concat(), at)
}

#[test]
fn vtu() {
    let (data, at) = triangle(i32::to_le_bytes);
    let file = |nodes, cells, at, data: &[u8]| vtu_file("", &vtu_piece(nodes, cells, at), data);
    assert!(read(&file(3, 1, at, &data), Format::Vtu).is_ok());
    let check = |bytes: &[u8], code, words| check(Format::Vtu, bytes, code, words);
    check(
        &file(4_000_000_000, 1, at, &data),
        "inconsistent",
        "'points' holds 9 numbers, but NumberOfPoints is 4000000000",
    );
    check(&file(u64::MAX, 1, at, &data), "inconsistent", "line 3: the array 'points'");
    check(&file(3, 4_000_000_000, at, &data), "inconsistent", "NumberOfCells is 4000000000");
    check(&file(3, 1, [usize::MAX >> 1; 4], &data), "truncated", "starts after the end of the appended data");
    check(&file(3, 1, [at[0], at[1], at[2], data.len() + 5], &data), "truncated", "the array 'types'");
    check(&file(3, 1, at, &data[..10]), "truncated", "line 3: the array 'points'");
    let endless = [&[0xFF; 8], &data[8..]].concat();
    check(&file(3, 1, at, &endless), "truncated", "has less data than it says");
    let odd = [&35_u64.to_le_bytes(), &data[8..]].concat();
    check(&file(3, 1, at, &odd), "inconsistent", "data that end within a number");
    let (swapped, at) = triangle(i32::to_be_bytes);
    check(
        &file(3, 1, at, &swapped),
        "node-out-of-range",
        "line 5: the array 'connectivity' names node 16777216",
    );
    check(GARBAGE, "syntax", "line 1: the XML is not well formed");
    let negative = [&data[..at[1] + 16], &(-2_i32).to_le_bytes(), &data[at[1] + 20..]].concat();
    check(&file(3, 1, at, &negative), "node-out-of-range", "names node -2");
    let nan = [&data[..8], &f32::NAN.to_le_bytes(), &data[12..]].concat();
    check(&file(3, 1, at, &nan), "coordinate-not-finite", "node 0 has a coordinate");
    let past = [&data[..at[2] + 8], &99_i32.to_le_bytes(), &data[at[2] + 12..]].concat();
    check(&file(3, 1, at, &past), "inconsistent", "the nodes 0 to 99 of 3");
}

const ZLIB: &str = "compressor=\"vtkZLibDataCompressor\"";

/// `size` zeros in blocks of `block`, as VTK compresses them.
fn zeros(size: usize, block: usize) -> Vec<u8> {
    let packed = compress_to_vec_zlib(&vec![0; block], 9);
    let count = size / block;
    let mut data: Vec<u8> = [count, block, 0].iter().flat_map(|&n| (n as u64).to_le_bytes()).collect();
    data.extend((0..count).flat_map(|_| (packed.len() as u64).to_le_bytes()));
    data.extend((0..count).flat_map(|_| packed.iter().copied()));
    data
}

#[test]
fn vtu_bombs() {
    let check = |pieces: &str, data: &[u8], code, words| {
        check(Format::Vtu, &vtu_file(ZLIB, pieces, data), code, words)
    };
    // 2 GB of zeros, where the piece has three points: refused before a block is unpacked.
    let bomb = zeros(1 << 31, 1 << 20);
    check(
        &vtu_piece(3, 1, [0; 4]),
        &bomb,
        "inconsistent",
        "'points' holds 536870912 numbers, but NumberOfPoints is 3",
    );
    // The same where the piece says so itself.
    let nodes = (1 << 31) / 12;
    let even = zeros(nodes * 12, 12 * (nodes / 2048));
    let nodes = (nodes / 2048 * 2048) as u64;
    check(&vtu_piece(nodes, 1, [0; 4]), &even, "too-large", "than a file of this size should");
    // One block that unpacks to more than its size.
    let packed = compress_to_vec_zlib(&vec![0; 1 << 26], 9);
    let header: Vec<u8> = [1, 36, 0, packed.len() as u64].iter().flat_map(|n| n.to_le_bytes()).collect();
    check(&vtu_piece(3, 1, [0; 4]), &[header, packed].concat(), "inconsistent", "zlib cannot unpack");
    // A stream of zlib within a stream of zlib is no array.
    let nested = compress_to_vec_zlib(&compress_to_vec_zlib(&vec![0; 1 << 26], 9), 9);
    let header: Vec<u8> = [1, 36, 0, nested.len() as u64].iter().flat_map(|n| n.to_le_bytes()).collect();
    check(&vtu_piece(3, 1, [0; 4]), &[header, nested].concat(), "inconsistent", "zlib cannot unpack");
    // Blocks of nothing, and more blocks than there are bytes.
    let header = |sizes: [u64; 3]| sizes.iter().flat_map(|n| n.to_le_bytes()).collect::<Vec<u8>>();
    check(&vtu_piece(3, 1, [0; 4]), &header([1 << 40, 0, 0]), "inconsistent", "blocks of no bytes");
    check(&vtu_piece(3, 1, [0; 4]), &header([1 << 61, 1, 0]), "truncated", "has less data than it says");
    check(
        &vtu_piece(3, 1, [0; 4]),
        &header([u64::MAX, 1 << 63, 1]),
        "truncated",
        "has less data than it says",
    );
}

#[test]
fn vtu_pieces_that_share_their_data() {
    // The same points, asked for by 100 pieces.
    let nodes = 10_000;
    let data = sized(&vec![0; 12 * nodes]);
    let pieces = vtu_piece(nodes as u64, 0, [0; 4]).repeat(100);
    check(Format::Vtu, &vtu_file("", &pieces, &data), "too-large", "than a file of this size should");
    let packed = zeros(12 * nodes, 12 * nodes);
    check(Format::Vtu, &vtu_file(ZLIB, &pieces, &packed), "too-large", "than a file of this size should");
}
