(()=>{var{make:x}=document.currentScript.shared;var{CanvasPen:V}=document.currentScript.shared;var{BEHIND:q,DOTS:X,HALO_WIDTH:Y,HATCH_PITCH:J,HATCH_WIDTH:K,SERIF:Z,STYLES:z,colours:N}=document.currentScript.shared;var{writeNumber:O}=document.currentScript.shared;var{LIGHT:Q,Pen:ee,cornersOf:te,textParts:ne}=document.currentScript.shared;var{counted:k}=document.currentScript.shared;var{along:se}=document.currentScript.shared;var{tableLonlat:ae}=document.currentScript.shared;var{lonLatOf:L}=document.currentScript.shared;var{asCount:I}=document.currentScript.shared;var{Kept:j,filled:H,kernel:oe}=document.currentScript.shared;var{CIRCLE_RADIUS:re,STEP:ie}=document.currentScript.shared;var Oe=3,Ie=3,Me=class extends ee{#t=[];#e=[];text(e){let[n,t]=[b(this.width),b(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${n}" height="${t}" viewBox="0 0 ${n} ${t}">`,`<title>${F(e)}</title>`,...this.#t.length>0?[`<defs>${this.#t.join("")}</defs>`]:[],`<rect width="${n}" height="${t}" ${v("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${Z}'>`,...this.#e].join(`
`)}
</g>
</svg>
`}draw(e,n,t){let s=le(n);if(s==="")return;let a=z[e],o=[];a.hatch!==void 0&&o.push(`fill="url(#${this.#r(a.hatch)})"`),a.fill!==void 0&&o.push(v("fill",t??this.colours[a.fill],a.fillOpacity)),a.stroke!==void 0&&o.push(this.#n(a,t)),this.#e.push(`<path class="${e}" ${o.join(" ")} d="${s}"/>`)}behind(e){this.#s(`opacity="${q}"`,e)}clipped(e,n){let t=`clip-${this.#t.length}`;this.#t.push(`<clipPath id="${t}"><path d="${le(e)}"/></clipPath>`),this.#s(`clip-path="url(#${t})"`,n)}dots(e,n){if(n.length===0)return;let{radius:t,fill:s,rim:a,rimWidth:o}=X[e],r=b(t-o/2),l=`dots-${this.#t.length}`,i=[];for(let d=0;d<n.length;d+=2)i.push(`<circle cx="${b(n[d])}" cy="${b(n[d+1])}" r="${r}"/>`);this.#t.push(`<g id="${l}">${i.join("")}</g>`);let c=`fill="none" ${v("stroke",this.colours[a])} stroke-width="${b(2*o)}"`;this.#e.push(`<use class="${e}-rim" href="#${l}" ${c}/>`),this.#e.push(`<use class="${e}" href="#${l}" ${v("fill",this.colours[s])}/>`)}spots(e,n){let t=this.#n(z["spot-line"]);n.forEach((s,a)=>{let[o,r,l]=[e[3*a],e[3*a+1],e[3*a+2]].map(b),i=s==="transparent"?"":` ${v("fill",s)}`;this.#e.push(`<circle class="spot" cx="${o}" cy="${r}" r="${l}"${i} ${t}/>`)})}lowered(e,n){this.#s(`transform="translate(0 ${b(e)})"`,n)}label(e,n,t,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],o=ne(e,s.italic??!1).map(i=>i.italic?`<tspan font-style="italic">${F(i.text)}</tspan>`:F(i.text)).join(""),r=`paint-order="stroke" ${v("stroke",this.colours[s.halo])} stroke-width="${Y}"`,l=`x="${b(n)}" y="${b(t)}" font-size="${s.size}" text-anchor="${a}"`;this.#e.push(`<text ${l} ${v("fill",this.colours[s.ink])} ${r}>${o}</text>`)}picture(e,n,t,s,a){let o=document.createElement("canvas");[o.width,o.height]=[e.width,e.height],o.getContext("2d").drawImage(e,0,0);let r=`x="${b(n)}" y="${b(t)}" width="${b(s)}" height="${b(a)}"`;this.#e.push(`<image ${r} preserveAspectRatio="none" href="${o.toDataURL("image/png")}"/>`)}#n(e,n=this.colours[e.stroke??"ink"]){let t=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`,s=b((e.width??1)*this.weight);return`${v("stroke",n)} stroke-width="${s}"${t}`}#s(e,n){this.#e.push(`<g ${e}>`),n(),this.#e.push("</g>")}fillDisc({x:e,y:n,r:t},s){let a=typeof s=="string"?v("fill",s):`fill="url(#${this.#o(s)})"`;this.#e.push(`<circle ${a} cx="${b(e)}" cy="${b(n)}" r="${b(t)}"/>`)}#o({id:e,stops:n}){let t=n.map(([a,o])=>`<stop offset="${a}" ${v("stop-color",o,1,"stop-opacity")}/>`),s=Object.entries(Q).map(([a,o])=>`${a}="${b((o+(a==="r"?0:1))/2)}"`);return this.#a(e,`<radialGradient id="${e}" ${s.join(" ")}>${t.join("")}</radialGradient>`)}#r(e){let[n,t]=[`hatch-${e}`,J],s=`M0 ${t/2}H${t}${e==="crossed"?`M${t/2} 0V${t}`:""}`,a=`${v("stroke",this.colours.hatch)} stroke-width="${K}"`,o=`width="${t}" height="${t}" patternUnits="userSpaceOnUse" patternTransform="rotate(-45)"`;return this.#a(n,`<pattern id="${n}" ${o}><path ${a} d="${s}"/></pattern>`)}#a(e,n){return this.#t.includes(n)||this.#t.push(n),e}};function le(e){let n="";return e({moveTo:(t,s)=>n+=`M${b(t)} ${b(s)}`,lineTo:(t,s)=>n+=`L${b(t)} ${b(s)}`,ellipse(t,s,a,o,r,l,i,c=!1){let[d,h]=[Math.cos(r),Math.sin(r)],p=f=>{let[g,m]=[a*Math.cos(f),o*Math.sin(f)];return[t+g*d-m*h,s+g*h+m*d]};n===""?this.moveTo(...p(l)):this.lineTo(...p(l));let y=Math.ceil(Math.abs(i-l)/Ie),u=`${b(a)} ${b(o)} ${b(r*180/Math.PI)} 0 ${c?0:1}`;for(let f=1;f<=y;++f){let[g,m]=p(l+(i-l)*f/y);n+=`A${u} ${b(g)} ${b(m)}`}},closePath:()=>n+="Z"}),n}function b(e){return O(e,Oe)}function v(e,n,t=1,s=`${e}-opacity`){let[a,o,r,l=1]=(n.match(/[\d.]+/g)??[]).map(Number),i=l*t,c=i===1?"":` ${s}="${b(i)}"`;return`${e}="rgb(${a}, ${o}, ${r})"${c}`}function F(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var _={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},A=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,Ce=new Set(_.missing),T=e=>Ce.has(e.trim().toLowerCase()),ze=new RegExp(`[^\\x00-\\x7f${_.western}]|[^\\x00-\\x7f]{3}`),je="぀";function U(e,n=!1){let t=["lon","lat"].map(o=>{let[r,l]=[_[o],_[`unsure_${o}`]],i=u=>u.trim().toLowerCase(),c=(u,f)=>i(f).includes(u)&&(u>je||ce(f).includes(u)),d=u=>ce(u).filter(f=>!_.beside.includes(f)),y=[u=>r.includes(i(u)),u=>r.some(f=>c(f,u)),u=>l.includes(i(u))||d(u).length>0&&d(u).every(f=>l.includes(f))].slice(0,n?2:3).map(u=>e.filter(u)).find(u=>u.length>0);return y?.length===1?y[0]:null}),[s,a]=t;return s===null||a===null||s===a?null:[s,a]}function ce(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(Boolean)}var He=new RegExp(`^(?:${_.lettered})$`,"iu"),Fe=new RegExp(`[${_.printed}${_.unseen}]|\\p{Nd}`,"gu");function W(e){let n=t=>{let s=[..._.zeros].find(o=>t>=o&&t.charCodeAt(0)-o.charCodeAt(0)<10);if(s!==void 0)return String(t.charCodeAt(0)-s.charCodeAt(0));let a=_.printed.indexOf(t);return a<0?_.unseen.includes(t)?"":t:_.typed[a]};return e.replace(Fe,n).trim().replace(/\s+/g," ")}var Ue=new Map(Object.entries({..._.compass,O:"O"}).flatMap(([e,n])=>[e,...n.toLowerCase().split(" ")].map(t=>[t,e]))),ye=e=>Ue.get(e.length>1?e.toLowerCase():e),de="[0-9]+(?:[.,][0-9]*)?",We=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${de})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${de})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function Ge(e){let n=e.length>200?null:We.exec(W(e))?.groups;if(!n)return null;let{before:t,after:s,sign:a}=n,o=[n.degrees,n.minutes,n.seconds].filter(h=>h!==void 0),r=t??s?ye(t??s):"",l=o.slice(0,-1).every(h=>/^[0-9]+$/.test(h)),i=o.map(h=>h.replace(",",".").replace(/\.$/,""));return r===void 0||t&&s||r&&a||!l||i.slice(1).some(h=>Number(h)>=60)?null:{degrees:(r==="W"||r==="S"||a==="-"?-1:1)*(r==="O"?NaN:Be(i)),point:r}}function Be(e){if(e.length===1)return Number(e[0]);let n=e[e.length-1].split(".")[1]?.length??0,[t,s,a=0n]=e.map((c,d)=>{let h=d===e.length-1;return BigInt(c.replace(".",""))*(h?1n:10n**BigInt(n))}),[o,r]=[(t*60n+s)*60n+a,3600n*10n**BigInt(n)],l=128+r.toString(2).length,i=o<<BigInt(l);return Number(i/r|(i%r===0n?0n:1n))/2**l}var we=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,Ve=/^[-+]?0[0-9]/;function qe(e){let[n,t]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return n.length===1&&t.length===1?[n[0],t[0]]:e.length===2?[e[0],e[1]]:null}function Xe(e,n,t){let[s,a]=[he(e,n,"longitude"),he(e,t,"latitude")];return $e(Se(s,a),e.wrong)}function $e(e,n){for(let t=0;t<e.length/2;++t){let[s,a]=[e[2*t],e[2*t+1]];n.has(t)||(Math.abs(a)>90?n.set(t,`latitude ${a} is outside [-90, 90]; is it the longitude, or not in degrees?`):Math.abs(s)>360&&n.set(t,`longitude ${s} is outside [-360, 360]`))}return e}function Ye(e,n,t){let s=xe(e.columns),a=[n,t].map(o=>Pe(e,o,e.columns.get(o),r=>ve(r,s)?"may have a decimal mark or thousands; write thousands without one":ke(r)));return Se(a[0],a[1])}function Je(e,n){let t=xe(e),s=o=>A.test(o)&&!Ve.test(o)&&!ve(o,t),a=new Map;for(let[o,r]of e){let l=i=>T(i)||s(i.trim());n.has(o)||!r.every(l)||r.every(T)||a.set(o,Float64Array.from(r,i=>T(i)?NaN:Ee(i.trim())))}return a}function xe(e){let n=new Set;for(let t of e.values())for(let s of t){if(!/[.,]/.test(s))continue;let a=s.trim();A.test(a)&&!we.test(a)&&n.add(_e(a))}return[...n].join("")||"."}var _e=e=>e.includes(",")?",":".",ve=(e,n)=>we.test(e)&&_e(e)!==n;function Se(e,n){return Float64Array.from({length:2*e.length},(t,s)=>(s%2===0?e:n)[s>>1])}var Ee=e=>Number(e.replace(",","."));function he(e,n,t){return Pe(e,t,Ke(e,n,t),s=>{let a=A.test(s)?null:Ge(s);if(a===null)return ke(s);let o=a.point===""?t:/[NS]/.test(a.point)?"latitude":"longitude";return o!==t?`is a ${o}`:a.point==="O"?"has an O, which is east in German and west in French; write E or W in its place":a.degrees})}function Ke({columns:e},n,t){let[s,a]=[e.get(n),[...e.keys()]],o=a[a.indexOf(n)+1]??"";if(!He.test(o))return s;let[r,l]=[s,e.get(o)].map(d=>d.map(h=>T(W(h))?"":W(h))),i=l.filter(Boolean).map(d=>ye(d)??"?");return i.length>0&&i.every(d=>(t==="latitude"?"NS":"EWO").includes(d))&&!r.some(d=>d.includes("-"))?r.map((d,h)=>d&&`${d} ${l[h]}`.trim()):s}var ke=e=>A.test(e)?Ee(e):NaN;function Pe({wrong:e},n,t,s){return Float64Array.from(t,(a,o)=>{let r=a.trim(),l=s(r);if(typeof l=="number"&&Number.isFinite(l))return l;let i=typeof l=="string"?l:"is not a number";return e.has(o)||e.set(o,`the ${n} ${T(r)?"is missing":`'${r}' ${i}`}`),NaN})}var Ze=[",",";","	","|"],Qe=50,et=20,M=/\r\n|\n|\r/,tt=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function nt(e){let n=tt.exec(e)?.[0]??"",t=e.slice(n.length),s=st(t),a=n.split(M).length,r=[...s===null?at(t,a):ot(t,s,a)].filter(({cells:g})=>g.some(m=>m.trim()!==""));if(r.length===0)throw new $("the table is empty: there is not even a line with the names of the columns");let{names:l,data:i}=rt(r),c=i.length<r.length,d=l.find((g,m)=>g!==""&&l.indexOf(g)!==m);if(d!==void 0)throw new $(`there are several columns with the name '${d}'`);let h=l.map(()=>[]),p=new Map,y=l.reduce((g,m,w)=>m===""?g:w+1,0);i.forEach(({cells:g},m)=>{let w=g.length>=y&&g.slice(l.length).every(P=>P===""),[D,C]=[`${g.length} field${g.length===1?"":"s"}`,`${l.length} columns`];w||p.set(m,`has ${D}, but there are ${C}`),h.forEach((P,R)=>P.push(g[R]??""))});let f=l.map((g,m)=>[g||`column_${m+1}`,h[m]]).filter(([,g],m)=>l[m]!==""||g.some(w=>w!==""));return{columns:new Map(f),count:i.length,isHeaded:c,lines:i.map(({line:g})=>g),wrong:p}}function st(e){let n=e.split(M,Qe).filter(i=>i.trim()!==""),t=n.map(i=>i.replace(/"[^"]*"/g,"")),a=Ze.map(i=>({mark:i,widths:t.map(c=>c.split(i).length)})).filter(({widths:i})=>Math.max(0,...i)>1),o=a.filter(({widths:i})=>new Set(i).size===1),r=[...new Set(n.map(i=>i.trim().split(/\s+/).length))];if(a.length===0||o.length===0&&r.length===1&&r[0]>1)return null;let l=({widths:i})=>Math.max(...i.map(c=>c>1?1e6*i.filter(d=>d===c).length+c:0));return(o.length>0?o:a).reduce((i,c)=>l(c)>l(i)?c:i).mark}function*at(e,n){for(let[t,s]of e.split(M).entries())yield{cells:s.trim().split(/\s+/),line:n+t}}function*ot(e,n,t){let s=`[^"\\${n}\\r\\n][^\\${n}\\r\\n]*`,a=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${s})?)(\\${n}|\\r\\n|\\n|\\r|$)`,"y"),[o,r,l]=[[],t,t];for(;a.lastIndex<e.length;){let i=a.exec(e);if(i===null){let c="a field begins with a quotation mark but does not end with one";throw new $(`line ${r}: ${c}; inside such a field write it twice`)}i[1]!==void 0&&(l+=i[1].split(M).length-1),o.push(i[1]?.replaceAll('""','"')??i[2]??""),i[3]!==n&&(yield{cells:o,line:r},[o,r]=[[],++l])}o.length>0&&(yield{cells:[...o,""],line:r})}function rt(e){let n=e.slice(0,et).map(({cells:c})=>c.map(d=>d.trim())),t=n.map(c=>c.filter(d=>d!=="")),s=c=>A.test(c),a=t.findIndex((c,d)=>U(c)!==null&&(d===0||!c.some(s))),o=t.findIndex(c=>c.length>1),r=Math.max(0,a>=0?a:o);return a<0&&2*t[r].filter(s).length>t[r].length?{names:n[r].length===2?["lon","lat"]:n[r].map((c,d)=>`column_${d+1}`),data:e.slice(r)}:{names:n[r],data:e.slice(r+1)}}function it(e,{places:n,names:t=null,values:s=new Map}){let a=i=>Object.is(i,-0)?"-0.0":Number.isFinite(i)?`${i}`:"",o=i=>/[",\r\n]/.test(i)?`"${i.replaceAll('"','""')}"`:i,r=[...e,...t===null?[]:["name"],...[...s.keys()].map(o)],l=Array.from({length:n.length/2},(i,c)=>{let d=t===null?[]:[o(t[c])],h=[...s.values()].map(p=>a(p[c]));return[a(n[2*c]),a(n[2*c+1]),...d,...h].join(",")});return`${[r.join(","),...l].join(`
`)}
`}var $=class extends Error{},Re=class extends ${names;constructor(e){super("the table has no two columns of coordinates"),this.names=e}};function lt(e){let n=dt(e),t=E(n,"type")==="Feature"?[n]:E(n,"features");if(!Array.isArray(t))throw new $("the file is not a GeoJSON FeatureCollection of points");pt(n);let s=new Map,a=t.map((c,d)=>{let h=ht(c);return typeof h=="string"&&s.set(d,h),typeof h=="string"?[NaN,NaN]:h}),o=$e(Float64Array.from(a.flat()),s),r=t.map(c=>E(c,"properties")),l=new Set(r.flatMap(c=>Object.keys(c??{}))),i=new Map([...l].map(c=>[c,r.map(d=>ct(E(d,c)))]));return{places:o,table:{columns:i,count:t.length,isHeaded:!0,lines:[],wrong:s}}}function ct(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function E(e,n){return typeof e=="object"&&e!==null?e[n]:void 0}function dt(e){try{return JSON.parse(e)}catch(n){let t=e.split(`
`).map(s=>s.replace(/^[\x1e \t\r]+|[\x1e \t\r]+$/g,""));try{if(!t[0].endsWith("}"))throw n;return{features:t.filter(s=>s!=="").map(s=>JSON.parse(s))}}catch{throw new $(`the file is not JSON: ${n instanceof Error?n.message:String(n)}`)}}}function ht(e){let n=E(e,"geometry"),[t,s]=[E(n,"type"),E(n,"coordinates")],a=t==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(t!=="Point"&&!a)return`a Point is needed, not ${typeof t=="string"?t:"no geometry"}`;let o=a?s[0]:s,r=Array.isArray(o)?o.slice(0,2):[];return r.length===2&&r.every(Number.isFinite)?r:`a Point has two or three numbers, not ${JSON.stringify(o)}`}function pt(e){let n=E(e,"crs")??null;if(n===null)return;let t=String(E(E(n,"properties"),"name"));if(!/(CRS84|EPSG::4326|EPSG:4326)$/i.test(t))throw new $(`the file is in ${t}; the page reads longitude and latitude, the Python library transforms others`)}var pe=1e6,ut=/\.(jpe?g|png|webp|avif)$/i,ft=/\.(csv|tsv|txt)(\.gz)?$/i,gt=/\.(geojson|json|geojsonl|geojsons)(\.gz)?$/i,ue=[["a workbook",/\.(xls[xm]?|ods)$/i,/^PK\x03\x04/],["a GeoPackage",/\.(gpkg|sqlite)$/i,/^SQLite format 3/],["a shapefile",/\.(shp|shx|dbf|prj|zip)$/i,/^\0\0'\n/],["a Parquet file",/\.(geo)?parquet$/i,/^PAR1[^,;\t|]/],["a FlatGeobuf file",/\.fgb$/i,/^fgb\x03/],["a file of XML",/\.(km[lz]|gpx|gml)$/i,/^(\xef\xbb\xbf)?\s*<(\?xml|kml|gpx)/],["a file packed by bzip2",/\.bz2$/i,/^BZh[1-9]1AY/]];function Le(e){return e.type.startsWith("image/")||ut.test(e.name)}async function mt(e,n,t,s){let{text:a,guess:o}=$t(await wt(n),e),r=gt.test(e)||!ft.test(e)&&/^[\s\x1e]*\{/.test(a);if(r&&t==="plane")return{room:"globe"};let l=r?lt(a):yt(a,t,s);if("room"in l)return l;let{places:i,table:c,axes:d=[]}=l,{count:h,wrong:p}=c;if(h===0)throw new $("there are no points");if(h>pe){let m=`the page takes up to ${k(pe)}; for more there is the Python library`;throw new $(`there are ${k(h)} points; ${m}`)}let y=p.size===0?"":bt(c);if(p.size===h)throw new $(y);let u=(m,w)=>!p.has(w),f=new Map([...c.columns].map(([m,w])=>[m,w.filter(u)])),g=[...f.keys()].find(m=>m.trim().toLowerCase()==="name")??"";return{file:e,places:i.filter((m,w)=>u(0,w>>1)),names:f.get(g)??null,values:Je(f,new Set([...d,g])),leftOut:p.size,wrong:y,guess:o}}function bt({count:e,lines:n,wrong:t}){let s=[...t.keys()].reduce((l,i)=>Math.min(l,i)),a=t.size===e?"No row":`${k(t.size)} of ${k(e)} rows`,o=n.length===0?"":`, on line ${k(n[s])}`,r=t.size===e?"can":"cannot";return`${a} ${r} be placed. Row ${k(s+1)}${o}: ${t.get(s)}`}function yt(e,n,t){let s=nt(e),a=[...s.columns.keys()],o=s.isHeaded?U(a,!0):null,r=t??(n==="lonlat"?U(a):qe(a));if(r===null&&o!==null)return{room:"globe"};if(r===null)throw new Re(a);let l=(n==="lonlat"?Xe:Ye)(s,...r),i=[...s.wrong.keys()].filter(c=>Number.isFinite(l[2*c]+l[2*c+1]));return n==="lonlat"&&o===null&&2*i.length>s.count?{room:"lift",columns:r}:{places:l,table:s,axes:r}}async function wt(e){if(!(e[0]===31&&e[1]===139))return e;try{let n=new Blob([e.slice()]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(n).arrayBuffer())}catch{throw new $("the compressed file is damaged")}}function $t(e,n){let t=String.fromCharCode(...e.subarray(0,64)),s=ue.find(([,l])=>l.test(n))??ue.find(([,,l])=>l.test(t)),o=`type: stereodel web ${/^[\w.-]+$/.test(n)?n:`"${n}"`}`;if(s!==void 0)throw new $(`this is ${s[0]}; to make a page of it, ${o}`);let r=/^(\xff\xfe|[^\0]\0)/.test(t)?"utf-16le":/^(\xfe\xff|\0)/.test(t)?"utf-16be":null;try{return{text:new TextDecoder(r??"utf-8",{fatal:!0}).decode(e),guess:null}}catch{let l=new TextDecoder("windows-1252").decode(e);if(r===null&&!ze.test(l))return{text:l,guess:"windows-1252"};throw new $(`neither a picture nor text in an encoding that the page knows; for others, ${o}`)}}async function Te(e,n,t,s,a){if(Le(e))return t.pass("globe",e);let{messages:o}=t,r=`${e.name}:`,l=f=>`${f}${/[.?!]$/.test(f)?"":"."} Nothing has changed.`,i;try{i=await mt(e.name,new Uint8Array(await e.arrayBuffer()),n,a)}catch(f){let g=(...m)=>Te(e,n,t,s,m);return f instanceof Re&&f.names.length>1?xt(e.name,f.names,n,o,g):o.show(r,l(f instanceof $?f.message:"the file cannot be read"))}if("room"in i)return t.pass(i.room,e,i.columns);let c=i,{leftOut:d,wrong:h,guess:p}=c,y=()=>{o.close(),s(c),p!==null&&o.show(r,`it does not say its encoding; read as ${p}.`)};if(d===0)return y();let u=d===1?"this row":`these ${k(d)} rows`;o.show(r,l(h),{words:`Open without ${u}`,act:y})}function xt(e,n,t,s,a){let o=t==="lonlat"?["Longitude","Latitude"]:["x","y"],r=o.map((c,d)=>{let h=x("select","",...n.map(p=>x("option","",p)));return h.selectedIndex=Math.min(d,n.length-1),h}),l={words:"Open",act:()=>a(r[0].value,r[1].value)},i=o.map((c,d)=>x("label","field column",`${c} `,r[d]));s.show(`Which columns of ${e}?`,"",l,i)}var _t=7;function vt(e,n="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let o=a.length===0?St:Et(a,n);return JSON.stringify({type:"Feature",properties:s,geometry:o})}).join(`,
`)}
]}
`}var St={type:"Polygon",coordinates:[[...te(-180,-90,180,90),[-180,-90]]]};function Et(e,n){let t=kt(e.flatMap((r,l)=>se(r,e[(l+1)%e.length])),n),s=Math.round((t[t.length-1][0]-t[0][0])/360),a=s===0?t:Pt(t,s),o=Rt(a).map(r=>[r.map(([l,i])=>[fe(l),fe(i)])]);return o.length===1?{type:"Polygon",coordinates:o[0]}:{type:"MultiPolygon",coordinates:o}}function fe(e){return Number(e.toFixed(_t))}function kt(e,n){let t=ae(Float64Array.from([...e,e[0]].flatMap(L)),n),s=[];for(let a=0;a<t.length;a+=2){let o=s[s.length-1]?.[0]??t[a];s.push([t[a]+360*Math.round((o-t[a])/360),t[a+1]])}return s}function Pt(e,n){let t=n>0?90:-90,s=n>0?[...e]:[...e].reverse(),a=360*Math.ceil((s[0][0]-180)/360)+180,o=s.findIndex(([h])=>h>=a),r=Ae(s[Math.max(0,o-1)],s[o===-1?s.length-1:o],a),l=s.slice(Math.max(o,0),-1).map(([h,p])=>[h-a-180,p]),i=s.slice(0,Math.max(o,0)).map(([h,p])=>[h-a+180,p]),c=[[-180,r],...l,...i,[180,r]],d=n>0?c:c.reverse();return[...d,[d[d.length-1][0],t],[d[0][0],t],d[0]]}function Ae(e,n,t){return e[0]===n[0]?e[1]:e[1]+(t-e[0])/(n[0]-e[0])*(n[1]-e[1])}function Rt(e){let n=e.map(([o])=>o),t=Math.floor((Math.min(...n)+180)/360),s=Math.ceil((Math.max(...n)+180)/360),a=[];for(let o=t;o<Math.max(s,t+1);++o){let r=e.slice(0,-1).map(([i,c])=>[i-360*o,c]),l=ge(ge(r,-180,1),180,-1);l.length>2&&a.push([...l,l[0]])}return a}function ge(e,n,t){let s=[];return e.forEach((a,o)=>{let r=e[(o+1)%e.length],[l,i]=[t*(a[0]-n)>=0,t*(r[0]-n)>=0];l&&s.push(a),l!==i&&a[0]!==n&&r[0]!==n&&s.push([n,Ae(a,r,n)])}),s}var me=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),be=2**15,Lt=class{width;height;texels;levels;constructor(e,n){if(this.width=I(n,"width",2,2**20),this.height=n/2,e.length!==4*this.width*this.height){let a=`four for each of ${n} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new j(Tt(e));let t=oe().run(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,me];this.levels=new j(H(Uint8Array,t,"raster_levels",...s))}warp(e,n){return this.painted(e,[-1,1,2/n,2/n],n,n)}painted(e,n,t,s,a=!0){I(t,"width",1,be),I(s,"height",1,be);let o=e.inverse(),r=Float64Array.of(...o.right.matrix,o.magnification,...o.left.matrix,0),i=[...[this.texels,this.levels,this.width,this.height,me],r,Float64Array.of(...n),t,s,a?1:0];return H(Uint8ClampedArray,4*t*s,"warp_raster",...i)}};function Tt(e){let n=Uint8Array.from(e);for(let t=0;t<n.length;++t)t%4!==3&&(n[t]=Math.floor((n[t]*n[t|3]+127)/255));return n}var At=4096,Dt=2,Nt=.25,Ot=.01;async function It(e,n,t){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>Ot){let l=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;n.show(`${e.name}:`,`the picture ${l??"cannot be read"}. Nothing has changed.`);return}let a=Math.round(Math.min(s.width,At)/2),o=x("canvas",{width:2*a,height:a}),r=o.getContext("2d",{willReadFrequently:!0});r.drawImage(s,0,0,o.width,o.height),s.close(),n.close(),t(new Mt(e.name,r.getImageData(0,0,o.width,o.height)))}var Mt=class{name;#t;#e;constructor(e,n){this.name=e,this.#t=new Lt(n.data,n.width),this.#e=jt(n)}draw(e,n,t,s){let a=s&&this.#e===null?Nt:Math.min(Dt,devicePixelRatio),o=Math.max(1,Math.ceil(2*n.r*a)),r=s&&this.#e!==null?this.#e(t,o):this.#n(t,o);e.clipped(l=>l.ellipse(n.x,n.y,n.r,n.r,0,0,2*Math.PI),()=>e.picture(r,n.x-n.r,n.y-n.r,2*n.r,2*n.r))}#n(e,n){let t=x("canvas",{width:n,height:n}),s=new ImageData(this.#t.painted(e,[-1,1,2/n,2/n],n,n,!1),n,n);return t.getContext("2d").putImageData(s,0,0),t}},Ct=`#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(place, 0.0, 1.0);
}`,zt=`#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D picture;
uniform mat3 left, right;
uniform float magnification;
out vec4 colour;
const float PI = 3.14159265358979;
void main() {
  float square = dot(place, place);
  vec3 seen = vec3(place, sqrt(max(0.0, 1.0 - square)));
  vec3 v = seen * left;
  float s = magnification, up = 1.0 + v.z, down = 1.0 - v.z;
  vec3 w = vec3(2.0 * s * v.xy, up - s * s * down) / (up + s * s * down) * right;
  vec2 at = vec2(atan(w.y, w.x) / (2.0 * PI) + 0.5, 0.5 - asin(clamp(w.z, -1.0, 1.0)) / PI);
  vec2 dx = dFdx(at), dy = dFdy(at);
  dx.x -= round(dx.x);
  dy.x -= round(dy.x);
  colour = square <= 1.02 ? textureGrad(picture, at, dx, dy) : vec4(0.0);
}`;function jt(e){let n=x("canvas"),t=n.getContext("webgl2",{antialias:!1,depth:!1,alpha:!0});if(t===null||t.getParameter(t.MAX_TEXTURE_SIZE)<e.width)return null;let s=t.createProgram();for(let[a,o]of[[t.VERTEX_SHADER,Ct],[t.FRAGMENT_SHADER,zt]]){let r=t.createShader(a);t.shaderSource(r,o),t.compileShader(r),t.attachShader(s,r)}return t.linkProgram(s),t.getProgramParameter(s,t.LINK_STATUS)?(t.useProgram(s),t.bindTexture(t.TEXTURE_2D,t.createTexture()),t.texImage2D(t.TEXTURE_2D,0,t.RGBA,t.RGBA,t.UNSIGNED_BYTE,e),t.generateMipmap(t.TEXTURE_2D),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,t.LINEAR_MIPMAP_LINEAR),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,t.REPEAT),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,t.CLAMP_TO_EDGE),({left:a,right:o,magnification:r},l)=>{n.width!==l&&(n.width=n.height=l),t.viewport(0,0,l,l);for(let[i,{matrix:c}]of Object.entries({left:a,right:o}))t.uniformMatrix3fv(t.getUniformLocation(s,i),!0,new Float32Array(c));return t.uniform1f(t.getUniformLocation(s,"magnification"),1/r),t.drawArrays(t.TRIANGLES,0,3),n}):null}var Ht=`from dataclasses import replace

import numpy as np
from stereodel import SphereCircle, SphericalVoronoi, bubble_to_bubble, fisheye, lonlat_to_xyz
from stereodel.drawing import DotStyle, LineStyle, View, as_color
from stereodel.globe import Globe, Panel, panels
from stereodel.io import read_points

RED, WASH = LineStyle("#d55e00", 1.8), "#d55e0021"
[!bubble] focus = {focus}
[!bubble] lens = fisheye(focus, magnification={magnification})
[bubble] taken, filled = SphereCircle.around({taken}), SphereCircle.around({filled})
[bubble] lens = bubble_to_bubble(taken, filled)
[places] places = {places}


def earth():
    globe = Globe(ocean="#dde9f1", limb=LineStyle("#4d4d4d", 1.3){latitude})
[picture]     globe.add_raster({picture})
[!picture land]     globe.add_land(color="#f4eddd", resolution="{resolution}")
[!picture land]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[graticule]     globe.add_graticule({step}, style=LineStyle("#a9b5be", 0.5))
[tissot]     globe.add_tissot({step}, {radius}, color="#40546629", style=LineStyle("#405466", 0.6))
[places cells]     cells = SphericalVoronoi.from_lonlat(places{latitude})
[places cells]     globe.add_cells(cells, style=LineStyle("#1b1b1b", 1.1))
[places]     globe.add_points(places, style=DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6))
[pointed]     globe.add_circles([SphereCircle.around({pointer}, {radius})], color=WASH, style=RED)
    return globe


[!bubble] globe = earth()
[!bubble] globe.add_points([focus], style=DotStyle("#fdfcfa", 5.9, RED.color, 1.8))
[!bubble] globe.add_labels([focus], ["focus"], offset=(9.0, 7.0), color="#ab4300", font="italic", size=15.0)
[!bubble] page = globe.page(lens, View({view}), width={width})
[bubble] before, after = earth(), earth()
[bubble] before.add_circles([taken], color=WASH, style=RED, name="rim")
[bubble] after.add_circles([taken], color=None, style=RED, name="rim")
[bubble] page = panels([Panel(before, None, View({before})), Panel(after, lens, View({view}))], width={width})
[bubble] page = replace(page, items=tuple(sorted(page.items, key=lambda item: item.name == "rim")))  # over the limb
replace(page.shaded(0.7), background=as_color("#fdfcfa")).save("globe.svg")
`,Ft=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, in_bubble
from stereodel.drawing import DotStyle, LineStyle, Polylines, Scene, Sketch, View

points = {points}
low, high = {corners}  # of the sheet
middle, diagonal = (low + high) / 2, np.hypot(*(high - low)) or 1.0
corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
sheet, view = PlanarDelaunay(points), View({view})
width, height, scale, contact = {width}, {height}, {scale}, np.array([{contact}])  # scale: of a diagonal
INK, GRAY, RED = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#d55e00", 1.8)
HULL, SIDE, LIMB = LineStyle("#6d8598", 1.3), LineStyle("#1b1b1b", 1.3), LineStyle("#4d4d4d", 0.7)
PAPER, RAY, DOT = "#fdfcfa", LineStyle("#d55e00", 0.8, (5.0, 4.0)), DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6)
sketch = Sketch()


def in_plane(xy):
    """Where places of the sheet are on the picture, before they are lifted."""
    uv = scale * (xy - middle) / diagonal
    return contact + view.project(np.concatenate([uv, 0 * uv[..., :1]], axis=-1))


[seeing facets] def hatch(chosen):
[seeing facets]     """Lines 45° steep, 6 points apart, where places of the picture are chosen."""
[seeing facets]     reach = np.hypot(width, height) / 2
[seeing facets]     along, across = np.arange(-reach, reach), np.arange(-reach, reach, 6.0)[:, None]
[seeing facets]     places = np.stack([along - across, along + across], axis=-1) / np.sqrt(2) + [width / 2, height / 2]
[seeing facets]     row, end = np.nonzero(np.diff(chosen(places), axis=1, prepend=False, append=False))
[seeing facets]     ends = places[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[seeing facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[flat seeing facets] def outside(places):
[flat]     axes = np.linalg.inv(view.project(np.eye(3)[:2]))
[flat]     xy = (places - contact) @ axes * diagonal / scale + middle
[flat]     return ((low <= xy) & (xy <= high)).all(axis=-1) & (sheet.find_simplex(xy.reshape(-1, 2)).reshape(xy.shape[:2]) < 0)


[flat] sketch.add_polygon(in_plane(corners), name="sheet", color="#9db4c847")
[flat seeing facets] hatch(outside)
[flat seeing facets] sketch.add_edges(in_plane(points), sheet.convex_hull, name="hull", style=HULL)
[flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="delaunay", style=GRAY)
[flat cells facets] sketch.add_segments(in_plane(PlanarVoronoi(sheet).segments((*low, *high))[0]), name="voronoi", style=INK)
[flat] sketch.add_polyline(in_plane(corners), closed=True, name="side", style=SIDE)
[flat] images = in_plane(points)
[flat pair] sketch.add_segment(*images[[{pair}]], name="span", style=RED)
[flat] sketch.add_points(images, name="sites", style=DOT)
[!flat] radius = scale / (4 * np.tan(np.radians({corner}) / 2))
[!flat] projection, center = Stereographic((-90, 90), radius=radius), np.array([0.0, 0.0, -radius])


[!flat] def lifted(xy):
[!flat]     return projection.inverse(scale * (xy - middle) / diagonal)


[!flat] def outside(places):
[!flat]     axes = view.raised((places - contact - view.project(center)) / radius).reshape(-1, 3)
[!flat]     chosen, seen = np.zeros(len(axes), dtype=bool), np.isfinite(axes[:, 2])
[!flat]     xy = projection.forward(axes[seen] @ view.matrix) * diagonal / scale + middle
[!flat]     chosen[seen] = sheet.find_simplex(np.nan_to_num(xy, nan=1e300, posinf=1e300, neginf=-1e300)) < 0
[!flat]     return chosen.reshape(places.shape[:2])


[!flat] xyz = lifted(points)
[!flat] front, glass, span = (Scene(radius=radius, center=center, style=style, limb=LIMB) for style in ("solid", "glass", "none"))
[!flat seeing facets] uv = (points - middle) * 2.0 ** -np.round(np.log2(diagonal))  # rays that are exact
[!flat seeing facets] hull = SphericalDelaunay(np.column_stack([2 * uv, 1 - (uv**2).sum(axis=1)]))
[!flat seeing facets] closing = hull.simplices[in_bubble(*hull.points[hull.simplices].swapaxes(0, 1), (0, 0, -1)) >= 0]
[!flat seeing facets] front.add_edges(xyz, closing[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), name="hull", style=HULL)
[!flat] sketch.add_items(item for item in front.layout(view, at=contact) if item.name in {shown})
[!flat seeing facets] hatch(outside)
[!flat area] ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
[!flat area] through = lifted(np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1))
[!flat area] sides = [SphereArc(SphereCircle.through(*three), three[0], three[2]) for three in through]
[!flat area] glass.add_region(sides, name="sheet", color="#9db4c847")
[!flat triangles] glass.add_edges(xyz, sheet.edges, name="delaunay", style=GRAY)
[!flat area] glass.add_arcs(sides, name="side", style=SIDE)
[!flat] sketch.add_items(item for item in glass.layout(view, at=contact) if item.name not in ("ball", "limb"))
[!flat cells facets] steps = np.stack([arc.sample(65) for arc in SphericalVoronoi(xyz).ridge_arcs()], axis=1)
[!flat cells facets] xy = projection.forward(steps) * diagonal / scale + middle
[!flat cells facets] inside = ((low <= xy) & (xy <= high)).all(axis=-1) & (view.depth(steps) >= 0)
[!flat cells facets] pieces = np.stack([steps[:-1], steps[1:]], axis=2)[inside[:-1] & inside[1:]].reshape(-1, 3)
[!flat cells facets] lines = contact + view.project(center + radius * pieces)
[!flat cells facets] sketch.add_items([Polylines(lines, np.arange(0, len(lines) + 1, 2), INK.color, INK.width, "voronoi")])
[!flat] images = contact + view.project(center + radius * xyz)
[!flat] sketch.add_points(images[view.depth(xyz) >= 0], name="sites", style=DOT)
[!flat] sketch.add_polygon(in_plane(corners), name="plane", color="#9db4c819")
[!flat] sketch.add_polyline(in_plane(corners), closed=True, name="frame", style=LIMB)
[!flat] for arm in ([4.5, 0.0], [0.0, 3.5]):
[!flat]     sketch.add_segment(contact - arm, contact + arm, name="contact", style=LineStyle("#1b1b1b", 1.0))
[!flat pair] span.add_edges(xyz, [[{pair}]], name="span", style=RED)
[!flat pair] sketch.add_items(span.layout(view, at=contact))
[!flat pole] pole = contact + view.project(2 * center)
[letters] for site, letter in zip([{pair}], "PQ"):
[letters]     above = in_plane(points[site])
[!flat letters rays pole]     sketch.add_segment(pole, above, name="ray", style=RAY)
[!flat letters rays !pole]     sketch.add_segment(images[site], above, name="ray", style=RAY)
[letters !flat]     sketch.add_points(above, name="shadow", style=DotStyle(PAPER, 2.8, RED.color, 1.2))
[letters]     sketch.add_points(images[site], name="held", style=DotStyle(RED.color, 3.7, PAPER, 1.0))
[letters]     sketch.add_label(above, f"\${letter}$", (0.0, 9.0), valign="baseline", size=17.0, color="#ab4300")
[!flat pole] sketch.add_points(pole, name="pole", style=DotStyle("#1b1b1b", 2.3, PAPER, 0.6))
sketch.page((0, width, 0, height), width=width, background=PAPER).shaded(0.33).save("lift.svg")
`,Ut=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, PlaneLine, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, in_bubble, lonlat_to_xyz
from stereodel.data import airports, cities, stars
from stereodel.drawing import DotStyle, Fill, LineStyle, Scene, Sketch, View, as_color
from stereodel.io import read_points
from stereodel.triangulation import planar_part

lonlat = {sites}
delaunay = SphericalDelaunay.from_lonlat(lonlat)
points, pole, view = delaunay.points, lonlat_to_xyz(({pole})), View({view})
[facets] sees_pole = in_bubble(*points[delaunay.simplices].swapaxes(0, 1), pole) >= 0
[facets] triangles = delaunay.simplices[~sees_pole]  # those of the plane
[facets] sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
[facets] edges, count = np.unique(sides, axis=0, return_counts=True)  # those of the hull are sides of one triangle

size, ball, gap = {size}, {ball}, {gap}  # of each picture, of the ball, between the pictures
left, right = np.array([0.5 * size, 0.5 * size]), np.array([1.5 * size + gap, 0.5 * size])
frame = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (size / 2 - 1)
projection = Stereographic(-pole, radius=frame.max() / {reach})
flat = np.nan_to_num(projection.forward(points), nan=1e9)  # a site at the pole is far away
scene, sketch = Scene(limb=LineStyle("#4d4d4d", 1.3)), Sketch()
INK, GRAY, HULL = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#6d8598", 1.3)
RED, WASH, PAPER = LineStyle("#d55e00", 1.8), "#d55e0021", "#fdfcfa"
DOT, HELD = DotStyle("#1b1b1b", 2.5, PAPER, 0.6), DotStyle(RED.color, 3.7, PAPER, 1.0)


def path(corners):
    return np.linspace(corners, np.roll(corners, -1, axis=0), 4, axis=1)


[hatched facets] along, across = np.arange(-size, size), np.arange(-size, size, 6.0)[:, None]
[hatched facets] steep = np.stack([along - across, along + across], axis=-1) / np.sqrt(2)  # lines, 6 points apart


[hatched facets] def hatch(middle, chosen, lines=steep):
[hatched facets]     """The parts of lines of a picture that are chosen."""
[hatched facets]     row, end = np.nonzero(np.diff(chosen(lines), axis=1, prepend=False, append=False))
[hatched facets]     ends = middle + lines[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[hatched facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[hatched facets] def on_ball(facets, beyond):
[hatched facets]     """Chooses what lies on some facets, and beyond all triangles of the sphere or not."""
[hatched facets]     def chosen(places):
[hatched facets]         axes, found = view.raised(places / ball), np.zeros(places.shape[:2], dtype=bool)
[hatched facets]         seen = np.isfinite(axes[..., 2])
[hatched facets]         found[seen] = np.append(facets, beyond)[delaunay.find_simplex(axes[seen] @ view.matrix)]
[hatched facets]         return found
[hatched facets]     return chosen


[seeing facets] hull = PlanarDelaunay(flat[np.unique(triangles)])
[seeing facets] hatch(right, lambda places: hull.find_simplex(places.reshape(-1, 2)).reshape(places.shape[:2]) < 0)
[triangles facets] sketch.add_edges(right + flat, edges, name="delaunay", style=GRAY)
[triangles facets] scene.add_edges(points, delaunay.edges, name="delaunay", style=GRAY)
[cells facets] ridges, _ = PlanarVoronoi(flat[np.unique(triangles)]).segments((-size, -size, size, size))
[cells facets] sketch.add_segments(right + ridges, name="voronoi", style=INK)
[cells] scene.add_arcs(SphericalVoronoi(delaunay).ridge_arcs(), name="voronoi", style=INK)
[seeing facets] sketch.add_edges(right + flat, edges[count == 1], name="hull", style=HULL)
[seeing facets] scene.add_edges(points, edges[count == 1], name="hull", style=HULL)
[bubble aimed] triangle = delaunay.simplices[delaunay.find_simplex(lonlat_to_xyz(({aim})))]
[bubble aimed] bubble, pairs = SphereCircle.through(*points[triangle]), np.column_stack([triangle, np.roll(triangle, -1)])
[bubble aimed] scene.add_cap(bubble, name="bubble", color=WASH)
[bubble aimed] scene.add_circles([bubble], style=RED)
[bubble aimed] scene.add_edges(points, pairs, name="triangle", style=LineStyle(RED.color, 1.2))
[bubble aimed] image = projection.image_of(bubble)
[bubble aimed] if isinstance(image, PlaneLine):
[bubble aimed]     far = 9 * size * image.direction
[bubble aimed]     sketch.add_segment(right + image.point - far, right + image.point + far, name="circle", style=RED)
[bubble aimed] else:
[bubble aimed]     paths = [path(right + image.sample(720))] + [path(right + frame)] * image.outside
[bubble aimed]     sketch.add_items([Fill(tuple(paths), as_color(WASH), "bubble")])
[bubble aimed]     sketch.add_circle(right + image.center, image.radius, name="circle", style=RED)
[bubble aimed]     if not image.outside:
[bubble aimed]         sketch.add_edges(right + flat, pairs, name="triangle", style=LineStyle(RED.color, 1.2))
[step] before, new = SphericalDelaunay(points[: {step} - 1]), {step} - 1
[step] opened = before.simplices[in_bubble(*points[before.simplices].swapaxes(0, 1), points[new]) > 0]
[step] sides = opened[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).tolist()
[step] fan = np.array([[a, b, new] for a, b in sides if [b, a] not in sides], dtype=int).reshape(-1, 3)
[step] flat_fan = fan[in_bubble(*points[fan].swapaxes(0, 1), pole) < 0]
[step] if len(fan):
[step]     after, ring = dict(fan[:, :2].tolist()), [int(fan[0, 0])]
[step]     while after[ring[-1]] != ring[0]:
[step]         ring.append(after[ring[-1]])
[step]     scene.add_patch(points[ring], name="opened", color=WASH)
[step] for corners in flat_fan:
[step]     sketch.add_polygon(right + flat[corners], name="opened", color=WASH)
[step] planar = planar_part(before, pole)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
[step] scene.add_edges(points, before.edges, name="delaunay", style=GRAY)
[step] sketch.add_edges(right + flat, np.unique(np.sort(planar, axis=1), axis=0), name="delaunay", style=GRAY)
[step] scene.add_edges(points, fan[:, [2, 0]], name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] spokes = np.unique(flat_fan[:, [2, 0, 2, 1]].reshape(-1, 2), axis=0)
[step] sketch.add_edges(right + flat, spokes, name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] scene.add_edges(points, fan[:, :2], name="horizon", style=RED)
[step] sketch.add_edges(right + flat, flat_fan[:, :2], name="horizon", style=RED)
sketch.add_points((right + flat)[:{count}], name="sites", style=DOT)
scene.add_points(points[:{count}], name="sites", style=DOT)
[held] sketch.add_points((right + flat)[[{held}]], name="held", style=HELD)
[held] scene.add_points(points[[{held}]], name="held", style=HELD)
around = Fill((path(right + 9 * frame), path(right + frame)), as_color(PAPER), "paper")
sketch.add_items([around]).add_polyline(right + frame, closed=True, name="frame", style=LineStyle("#4d4d4d", 0.7))
ground, *items = scene.layout(view, at=left, scale=ball)
sketch.add_items([ground])
[seeing facets] hatch(left, on_ball(sees_pole, (sees_pole & delaunay.closing).any()))
[closing hemisphere] for lines in (steep, steep * [1, -1]):
[closing hemisphere]     hatch(left, on_ball(delaunay.closing, True), lines)
sketch.add_items(items)
at = left + ball * view.project(pole)
[front] sketch.add_points(at, name="pole", style=DotStyle(PAPER, 5.9, RED.color, 1.8))
[!front] sketch.add_circle(at, 5.0, name="pole", style=LineStyle(RED.color, 1.2))
sketch.add_label(at, "$P$", (11.0 if at[0] < left[0] else -11.0, 0.0), size=15.0, color="#ab4300")
page = sketch.page((0, 2 * size + gap, 0, size), width=2 * size + gap, background=PAPER)
page.shaded(0.33).save("sphere.svg")
`,Wt=200,De="cities().lonlat[cities().population >= 2_000_000]",Gt=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${De})`,Bt={cities:De,airports:`airports().lonlat[np.unique(${Gt})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function Vt(e,n,t,s){let{sites:a,view:o,twin:r,bubble:l,aim:i,step:c}=e,d=u=>c==="done"&&e.isOn(u),h=[...d("bubble")&&l?.sites||[],...c==="done"?e.held:[c.site]],p={facets:a.facetCount>0,hemisphere:a.hasClosing,step:c!=="done"&&c.insertion!==null,aimed:l!==null,held:h.length>0,front:o.seen(r.pole)[2]>=0,hatched:d("seeing")||d("closing")&&a.hasClosing},y={...s,sites:Bt[t.set]??B(a.lonlat,Ne(t.file)),pole:S(n),view:S(o.middle),aim:L(i).join(", "),held:h.join(", "),step:c==="done"?"":c.site+1,count:c==="done"?"":c.site+1};return G(Ut,y,p,d)}function qt(e,n,t,s){let{sites:a,sheet:o,view:r,isOn:l}=e,[i,c]=[e.p,e.q].filter(f=>f!==null),{contact:d,height:h}=n,p=a.count===0?[3,2]:s,y={facets:a.delaunay.dimension===2,flat:o.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:i!==void 0,pair:c!==void 0&&i!==c,pole:n.seenPole(h)!==null},u={points:B(a.places,`np.loadtxt(${JSON.stringify(t.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:p?`np.array([[-1, -1], [1, 1]]) * [${S(p)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:S(r.middle),width:n.width,height:h,scale:n.scale,contact:`${d[0]}, ${h-d[1]}`,corner:o.corner,pair:[i,c].join(", "),shown:JSON.stringify(n.grounds)};return G(Ft,u,y,l)}function Xt(e,n,t,s,a){let{lens:o,sight:r,from:l,to:i,before:c,after:d,pointer:h}=e,{places:p,latitude:y,picture:u,resolution:f}=n,g=o==="bubble",m=p===null||y==="spherical"?"":`, latitude="${y}"`,w=P=>{let R=`(${S(L(P))})`;return m===""?R:`lonlat_to_xyz(${R}${m})`},D=({middle:P,roll:R})=>S([...P,R]).replace(/, -?0$/,""),C={focus:w(r.lens.focus),magnification:S([r.lens.magnification]),taken:`${w(l.center)}, ${S([l.radius])}`,filled:`${w(i.center)}, ${S([i.radius])}`,places:B(p?.lonlat??new Float64Array(0),Ne(p?.name??"")),latitude:m,picture:JSON.stringify(u?.name??""),resolution:f,step:ie,radius:re.toFixed(4),pointer:w(h),before:D(c),view:D(g?d:r.view),width:S([1.03*s*(g?2:1)])};return G(Ht,C,{bubble:g,picture:u!==null,places:p!==null,pointed:a},t)}function G(e,n,t,s){let a=c=>t[c]??s(c),r=e.split(`
`).flatMap(c=>{let[,d,h]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(c);return d?.split(" ").every(y=>y.startsWith("!")?!a(y.slice(1)):a(y))===!1?[]:[h]}).join(`
`).replace(/\{(\w+)\}/g,(c,d)=>String(n[d]??c)),l=r.replace(/^(from|import) .*\n/gm,""),i=c=>new RegExp(`\\b${c.split(" as ").pop()}\\b`).test(l);return r.replace(/^((?:from \S+ )?import )(.*)\n/gm,(c,d,h)=>{let p=h.split(", ").filter(i);return p.length===0?"":`${d}${p.join(", ")}
`})}function B(e,n){if(e.length>2*Wt)return n;let t=Array.from({length:e.length/2},(a,o)=>`[${e[2*o]}, ${e[2*o+1]}]`),s=[];for(let a of t){let o=s[s.length-1];o!==void 0&&o.length+a.length<84?s[s.length-1]=`${o} ${a},`:s.push(`    ${a},`)}return s.length===0?"np.zeros((0, 2))":`np.array([
${s.join(`
`)}
])`}function Ne(e){return`read_points(${JSON.stringify(e)}).lonlat`}function S(e){return e.map(n=>O(n,7)).join(", ")}async function Yt(e,n){let t=e.cloneNode(!0);t.querySelector("#block-state")?.remove();let s=x("script",{type:"text/plain",id:"block-state"},await Jt(n));return t.querySelector("#block-kernel").before(s,`
`),new Blob([`<!doctype html>
`,t.outerHTML,`
`],{type:"text/html"})}async function Jt(e){let n=new Blob([e]).stream().pipeThrough(new CompressionStream("deflate")),t=await new Response(n).blob();return new Promise((s,a)=>{let o=new FileReader;o.onload=()=>s(String(o.result).replace(/^.*,/,"")),o.onerror=()=>a(o.error),o.readAsDataURL(t)})}function Kt(e,n,t="text/plain"){let s=typeof n=="string"?new Blob([n],{type:`${t};charset=utf-8`}):n,a=x("a",{href:URL.createObjectURL(s),download:e});a.click(),setTimeout(()=>URL.revokeObjectURL(a.href),6e4)}function Zt({title:e,width:n,height:t,weight:s,paint:a}){let o=new Me(n,t,N(),s);return a(o),o.text(e)}function Qt({width:e,height:n,weight:t,paint:s},a){let o=x("canvas",{width:Math.round(e*a),height:Math.round(n*a)}),r=o.getContext("2d");return r.fillStyle=N().paper,r.fillRect(0,0,o.width,o.height),s(new V(r,e,n,a,N(),t)),new Promise((l,i)=>{o.toBlob(c=>c===null?i(new Error("the picture is too large")):l(c))})}var en={csv:it,download:Kt,geojson:vt,globePython:Xt,isPicture:Le,liftPython:qt,openPanorama:It,openPoints:Te,savedPage:Yt,sheetPng:Qt,sheetSvg:Zt,spherePython:Vt};Object.assign(document.currentScript,{offers:en});})();
