//! ZIP archives byte by byte, after PKWARE's APPNOTE.TXT 6.3, so that they can lie in every field.

use std::io::Write;

/// A member; the fields are what is written, whatever the data are.
#[derive(Clone, Debug)]
pub struct ZipMember {
    pub name: Vec<u8>,
    /// The name in the local header, where it is another.
    pub local_name: Option<Vec<u8>>,
    pub data: Vec<u8>,
    pub flags: u16,
    pub method: u16,
    pub crc: u32,
    pub compressed: u32,
    pub size: u32,
    pub mode: u32,
    pub extra: Vec<u8>,
    /// Where the directory says that it begins, where that is elsewhere.
    pub start: Option<u32>,
}

impl ZipMember {
    /// A member that is stored as it is.
    pub fn stored(name: impl AsRef<[u8]>, data: impl AsRef<[u8]>) -> Self {
        let (name, data) = (name.as_ref().to_vec(), data.as_ref().to_vec());
        let size = u32::try_from(data.len()).unwrap();
        let crc = crc32fast::hash(&data);
        let (flags, method, mode, extra) = (0, 0, 0o100_644, Vec::new());
        Self { name, local_name: None, data, flags, method, crc, compressed: size, size, mode, extra, start: None }
    }

    /// The same with its name marked as UTF-8.
    pub fn utf8(self) -> Self {
        Self { flags: self.flags | 1 << 11, ..self }
    }

    /// A member compressed by Deflate, as any library does it.
    pub fn deflated(name: impl AsRef<[u8]>, data: &[u8]) -> Self {
        let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        let options = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated);
        writer.start_file("x", options).unwrap();
        writer.write_all(data).unwrap();
        let mut archive = writer.finish_into_readable().unwrap();
        let mut compressed = Vec::new();
        std::io::Read::read_to_end(&mut archive.by_index_raw(0).unwrap(), &mut compressed).unwrap();
        let plain = Self::stored(name, data);
        Self { compressed: u32::try_from(compressed.len()).unwrap(), data: compressed, method: 8, ..plain }
    }

    fn fields(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        for field in [20, self.flags, self.method, 0, 0] {
            bytes.extend(field.to_le_bytes());
        }
        for field in [self.crc, self.compressed, self.size] {
            bytes.extend(field.to_le_bytes());
        }
        bytes
    }
}

/// An archive of these members.
pub fn archive(members: &[ZipMember]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut directory = Vec::new();
    for member in members {
        let start = member.start.unwrap_or(bytes.len() as u32);
        let local_name = member.local_name.as_ref().unwrap_or(&member.name);
        bytes.extend(b"PK\x03\x04");
        bytes.extend(member.fields());
        bytes.extend((local_name.len() as u16).to_le_bytes());
        bytes.extend(0_u16.to_le_bytes());
        bytes.extend(local_name);
        bytes.extend(&member.data);

        directory.extend(b"PK\x01\x02");
        directory.extend([20, 3]);
        directory.extend(member.fields());
        for length in [member.name.len(), member.extra.len(), 0, 0, 0] {
            directory.extend((length as u16).to_le_bytes());
        }
        directory.extend((member.mode << 16).to_le_bytes());
        directory.extend(start.to_le_bytes());
        directory.extend(&member.name);
        directory.extend(&member.extra);
    }
    let (start, count) = (bytes.len() as u32, members.len() as u16);
    bytes.extend(&directory);
    bytes.extend(b"PK\x05\x06");
    for field in [0, 0, count, count] {
        bytes.extend(field.to_le_bytes());
    }
    bytes.extend((directory.len() as u32).to_le_bytes());
    bytes.extend(start.to_le_bytes());
    bytes.extend(0_u16.to_le_bytes());
    bytes
}
