# Doxygen's view of a file: the comment that opens a header describes the file, and a README.md, which opens with its
# folder's name, becomes a comment about the folder.
1{
  s|^///|/// \\file\n///|
  /^# /!b
  s|^# \(.*\)|/** \\dir \1|
  :append
  $!{
    N
    b append
  }
  s|$|\n*/|
}
